#include "app/pattern/test_pattern.h"

#include <algorithm>

#include <fmt/core.h>

#include "app/report/screen_page.h"
#include "app/report/stereo_picture.h"

namespace app {
namespace {

using render::Eye;

constexpr double kRingDepth_mm = 20.0;  ///< of the rings before and behind the screen

const Ink kBlack{0, 0, 0}, kWhite{1, 1, 1}, kGrey{0.45, 0.45, 0.45}, kFaint{0.28, 0.28, 0.28}, kSoft{0.75, 0.75, 0.75};
const Ink kLeftInk{0.80, 0.10, 0.10}, kRightInk{0.10, 0.25, 0.90};

void drawEyes(const ScreenPage& page, Eye eye) {
  const glm::dvec2 half = 0.5 * page.size_mm();
  const bool left = eye == Eye::left;
  const double unit = std::min(half.x, half.y);
  page.fill(eye == Eye::cyclopean ? kFaint : left ? kLeftInk : kRightInk);
  const char* const word = eye == Eye::cyclopean ? "ONE PICTURE" : left ? "LEFT" : "RIGHT";
  // Each word has its own half, so that both can be read together.
  const double y = eye == Eye::cyclopean ? 0.0 : left ? -0.42 * unit : 0.42 * unit;
  page.text(word, {0.0, y}, 0.42 * unit, kWhite);
  if (eye != Eye::cyclopean)
    page.text(left ? "Close the right eye: LEFT on red must remain" : "Close the left eye: RIGHT on blue must remain",
              {0.0, y + 0.30 * unit}, 0.065 * unit, kWhite);
  page.frame(0.012 * unit, kWhite);
}

void drawCrosstalk(const ScreenPage& page, Eye eye) {
  const glm::dvec2 half = 0.5 * page.size_mm();
  const bool left = eye == Eye::left;
  page.fill(kBlack);
  // Left half of the screen: white for the left eye alone; right half the other way round.
  const glm::dvec2 low{left ? -half.x : 0.0, -half.y};
  page.box(low, {half.x, half.y * 1.30}, kWhite);
  const Ink on_white = kBlack;
  page.text(left ? "LEFT" : "RIGHT", {(left ? -0.5 : 0.5) * half.x, -0.62 * half.y}, 0.16 * half.y, on_white);
  page.text("Close one eye: its half must be black", {(left ? -0.5 : 0.5) * half.x, -0.36 * half.y}, 0.06 * half.y,
            on_white);
  page.text("A ghost of the word is crosstalk", {(left ? -0.5 : 0.5) * half.x, -0.25 * half.y}, 0.06 * half.y,
            on_white);
  // The ghost is as bright as the grey step that looks the same.
  constexpr std::array kSteps{0.0, 0.5, 1.0, 2.0, 3.0, 5.0, 7.0, 10.0, 15.0, 20.0};
  const double width = 2.0 * half.x / static_cast<double>(kSteps.size());
  for (std::size_t s = 0; s < kSteps.size(); ++s) {
    const double light = kSteps[s] / 100.0;
    const glm::dvec2 corner{-half.x + static_cast<double>(s) * width, 0.42 * half.y};
    page.box(corner, {width, 0.58 * half.y}, greyOfLight(light));
    page.text(fmt::format("{:g} %", kSteps[s]), corner + glm::dvec2(0.5 * width, 0.46 * half.y), 0.055 * half.y, kSoft);
  }
  page.text("of white, in both eyes", {0.0, 0.36 * half.y}, 0.055 * half.y, kGrey);
}

void drawGrid(const ScreenPage& page) {
  const glm::dvec2 half = 0.5 * page.size_mm();
  const double shorter = 2.0 * std::min(half.x, half.y);
  const double square = shorter > 400.0 ? 50.0 : shorter > 120.0 ? 10.0 : shorter > 40.0 ? 5.0 : 1.0;
  page.fill(kBlack);
  const double thin = std::max(0.0012 * shorter, 1.2 * page.pixel_mm());
  for (int i = 0; static_cast<double>(i) * square <= std::max(half.x, half.y); ++i)
    for (const int sign : {-1, 1}) {
      const double at = sign * i * square;
      const bool strong = i % 5 == 0;
      const double width = i == 0 ? 3.0 * thin : strong ? 2.0 * thin : thin;
      const Ink ink = strong ? kWhite : kGrey;
      page.line({at, -half.y}, {at, half.y}, width, ink);
      page.line({-half.x, at}, {half.x, at}, width, ink);
    }
  page.circle({0.0, 0.0}, 0.40 * shorter, 2.0 * thin, kWhite);
  page.frame(4.0 * thin, kLeftInk);
  const std::string text =
      fmt::format("squares of {:g} mm, screen {:.1f} × {:.1f} mm", square, 2.0 * half.x, 2.0 * half.y);
  page.label(text, {0.0, -half.y + 0.10 * shorter}, 0.035 * shorter, kWhite);
  page.label("TOP", {0.0, -half.y + 0.045 * shorter}, 0.035 * shorter, kWhite);
  page.label("LEFT", {-half.x + 0.09 * shorter, 0.0}, 0.035 * shorter, kWhite);
  page.label("RIGHT", {half.x - 0.09 * shorter, 0.0}, 0.035 * shorter, kWhite);
}

void drawCross(const ScreenPage& page, const calibration::Rig& rig, Eye eye) {
  const glm::dvec2 half = 0.5 * page.size_mm();
  const double unit = std::min(half.x, half.y);
  page.fill(kBlack);
  page.line({-0.35 * unit, 0.0}, {0.35 * unit, 0.0}, 0.012 * unit, kWhite);
  page.line({0.0, -0.35 * unit}, {0.0, 0.35 * unit}, 0.012 * unit, kWhite);
  const auto ring_at = [&](double height_mm, double x, const Ink& ink, const std::string& label) {
    const glm::dvec2 seen = page.seenAt(rig, eye, {x, 0.0}, height_mm);
    page.circle(seen, 0.24 * unit, 0.016 * unit, ink);
    page.text(label, seen + glm::dvec2(0.0, 0.40 * unit), 0.065 * unit, ink);
  };
  ring_at(kRingDepth_mm, -0.68 * unit, {0.95, 0.75, 0.25}, fmt::format("{:.0f} mm before", kRingDepth_mm));
  ring_at(-kRingDepth_mm, 0.68 * unit, {0.35, 0.75, 0.95}, fmt::format("{:.0f} mm behind", kRingDepth_mm));
  page.text("The cross lies on the screen: one cross, not two", {0.0, -0.62 * unit}, 0.065 * unit, kWhite);
  page.text("the left ring is nearer than it, the right ring farther; the other way round: swap the eyes",
            {0.0, -0.50 * unit}, 0.05 * unit, kGrey);
}

void drawText(const ScreenPage& page) {
  const glm::dvec2 half = 0.5 * page.size_mm();
  page.fill(kBlack);
  double y = -0.82 * half.y;
  for (const double height : {12.0, 8.0, 6.0, 4.0, 3.0, 2.5, 2.0, 1.5, 1.0}) {
    if (y + 1.5 * height > 0.55 * half.y) continue;
    page.text(fmt::format("{:.1f} mm   mandibular canal 38 – 48   Ångström", height), {0.0, y + 0.5 * height}, height,
              kWhite);
    y += 1.5 * height + 1.0;
  }
  // Pairs of lines, from one device pixel up, must not merge to grey.
  const double pixel = page.pixel_mm();
  double x = -0.9 * half.x;
  for (const int pixels : {1, 2, 3, 4, 6, 8}) {
    const double line = pixels * pixel, length = 0.16 * half.x;
    for (int n = 0; n * 2.0 * line < length; ++n)
      page.pixelBox({x + 2.0 * n * line, 0.66 * half.y}, {line, 0.22 * half.y}, kWhite);
    page.text(fmt::format("{} px", pixels), {x + 0.5 * length, 0.94 * half.y}, 0.05 * half.y, kGrey);
    x += 0.31 * half.x;
  }
}

}  // namespace

std::optional<TestPattern> testPatternNamed(std::string_view name) {
  for (const TestPatternName& known : kTestPatterns)
    if (known.name == name) return known.pattern;
  return std::nullopt;
}

render::Image patternFor(TestPattern pattern, const calibration::Rig& rig, Eye eye, glm::ivec2 px) {
  ScreenPage page(rig, px);
  if (pattern == TestPattern::eyes) drawEyes(page, eye);
  if (pattern == TestPattern::crosstalk) drawCrosstalk(page, eye);
  if (pattern == TestPattern::grid) drawGrid(page);
  if (pattern == TestPattern::cross) drawCross(page, rig, eye);
  if (pattern == TestPattern::text) drawText(page);
  return page.picture();
}

render::Image patternOutput(TestPattern pattern, const calibration::Rig& rig, const render::StereoLayout& layout) {
  const glm::ivec2 eye_px = render::eyeImageSize(layout.mode, layout.screen_px);
  if (layout.mode == render::DisplayMode::mono) return patternFor(pattern, rig, Eye::cyclopean, eye_px);
  return stereoPicture(patternFor(pattern, rig, Eye::left, eye_px), patternFor(pattern, rig, Eye::right, eye_px),
                       layout);
}

}  // namespace app
