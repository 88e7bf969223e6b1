// Display test patterns, one image per eye, laid out in millimetres on the (virtual) screen as the viewer sees it: with
// or without a mirror, text reads from left to right and a square of 10 mm measures 10 mm. No OpenGL.
//   eyes       a word and a colour for each eye
//   crosstalk  white in one eye, black in the other, and grey steps to compare the leakage with
//   grid       squares of a stated size, a circle, the middle: scale, shape, mirror
//   cross      a cross on the screen, rings in front of and behind it: depth
//   text       text of stated heights and pairs of lines: sharpness
// Any one thread; a tenth of a second.
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

/// One eye's image of `px`, covering the rig's screen.
render::Image patternFor(TestPattern pattern, const calibration::Rig& rig, render::Eye eye, glm::ivec2 px);

/// The display's output: both eyes in the given layout, anaglyphs mixed in linear light.
render::Image patternOutput(TestPattern pattern, const calibration::Rig& rig, const render::StereoLayout& layout);

}  // namespace app
