// Pictures for the technician, one per eye, laid out in millimetres on the (virtual) screen as the person before it
// sees it: through a mirror or not, words read from left to right and a square of 10 mm measures 10 mm. No patient, no
// OpenGL.
//   eyes       which eye is which: a word and a colour each
//   crosstalk  white in one eye, black in the other, in fields and steps of grey: what leaks through is seen
//   grid       squares of a stated size, a circle, the middle: scale, shape, mirror
//   cross      a cross on the screen, rings before and behind it: depth
//   text       words of stated heights and pairs of lines: sharpness
// Cairo and Pango draw, inside. Any one thread; a tenth of a second.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "calibration/rig.h"
#include "render/display/eye_projection.h"
#include "render/display/stereo_layout.h"
#include "render/image.h"

namespace app {

enum class TestPattern { eyes, crosstalk, grid, cross, text };

struct TestPatternName {
  TestPattern pattern;
  std::string_view name;
};

inline constexpr std::array<TestPatternName, 5> kTestPatterns = {{
    {TestPattern::eyes, "eyes"},
    {TestPattern::crosstalk, "crosstalk"},
    {TestPattern::grid, "grid"},
    {TestPattern::cross, "cross"},
    {TestPattern::text, "text"},
}};

std::optional<TestPattern> testPatternNamed(std::string_view name);

/// One eye's picture, `px` large, over the whole of the rig's screen.
render::Image patternFor(TestPattern pattern, const calibration::Rig& rig, render::Eye eye, glm::ivec2 px);

/// What the display is given: every pixel from the eye the layout says, mixed in linear light for anaglyphs.
render::Image patternOutput(TestPattern pattern, const calibration::Rig& rig, const render::StereoLayout& layout);

}  // namespace app
