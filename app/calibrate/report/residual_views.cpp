#include "app/calibrate/report/residual_views.h"

#include <algorithm>
#include <cmath>

#include "app/report/axis_ticks.h"
#include "app/report/svg.h"

namespace app {
namespace {

using calibration::Residual;

constexpr double kHeight = 400.0, kLeft = 46.0, kTop = 44.0, kGap = 60.0, kBelow = 78.0, kPage = 760.0;
constexpr double kUsual = 50.0, kForLarge = 10.0, kLarge_mm = 1.2, kLeastHalf_mm = 30.0;

/// Which two coordinates, and which way they run on paper.
struct View {
  const char *title, *across_label;
  int across;
  double sense;
};
constexpr View kFront = {"From the front", "x, to the right / mm", 0, 1.0};
constexpr View kRight = {"From the right", "z, towards the viewer / mm", 2, -1.0};

/// mm in W to px: the same for both views, so that lengths can be compared.
struct Frame {
  glm::dvec3 low_mm{1e9}, high_mm{-1e9};
  double px_per_mm = 1.0;

  void hold(const glm::dvec3& p) {
    low_mm = glm::min(low_mm, p);
    high_mm = glm::max(high_mm, p);
  }
  double width(const View& view) const { return px_per_mm * (high_mm - low_mm)[view.across]; }
  glm::dvec2 at(const View& view, double left, const glm::dvec3& p) const {
    const double from_low = p[view.across] - low_mm[view.across], from_high = high_mm[view.across] - p[view.across];
    return {left + px_per_mm * (view.sense > 0.0 ? from_low : from_high), kTop + px_per_mm * (high_mm.y - p.y)};
  }
};

double enlargement(const std::vector<Residual>& a, const std::vector<Residual>& b) {
  double longest_mm = 0.0;
  for (const auto* list : {&a, &b})
    for (const Residual& one : *list)
      if (one.used) longest_mm = std::max(longest_mm, glm::length(one.error_mm.xyz));
  return longest_mm > kLarge_mm ? kForLarge : kUsual;
}

Frame frameOf(const std::vector<Residual>& fitted, const std::vector<Residual>& held_out, double times) {
  Frame frame;
  frame.hold(glm::dvec3(-kLeastHalf_mm));
  frame.hold(glm::dvec3(kLeastHalf_mm));
  for (const auto* list : {&fitted, &held_out})
    for (const Residual& one : *list) {
      frame.hold(one.target_W.mm);
      if (one.used) frame.hold(one.target_W.mm + times * one.error_mm.xyz);
    }
  frame.low_mm -= 6.0, frame.high_mm += 6.0;
  const glm::dvec3 size = frame.high_mm - frame.low_mm;
  frame.px_per_mm = std::min((kHeight - kTop - kBelow) / size.y, (kPage - 2.0 * kLeft - kGap) / (size.x + size.z));
  return frame;
}

void drawAxes(Svg& svg, const Frame& frame, const View& view, double left) {
  const double width = frame.width(view), height = frame.px_per_mm * (frame.high_mm.y - frame.low_mm.y);
  svg.box({left, kTop}, {width, height}, paper::kNone, {paper::kQuiet, 1.0});
  svg.words({left, kTop - 9.0}, "y, upwards / mm", TextAnchor::start, paper::kInk, 11.5);
  svg.words({left, kTop - 28.0}, view.title, TextAnchor::start, paper::kInk, 13.0, true);
  const AxisTicks across = axisTicks(frame.low_mm[view.across], frame.high_mm[view.across], 5, false);
  for (const double tick : across.at) {
    glm::dvec3 p = frame.low_mm;
    p[view.across] = tick;
    const glm::dvec2 foot = frame.at(view, left, p);
    svg.line(foot, {foot.x, kTop}, {paper::kFaint, tick == 0.0 ? 1.6 : 0.7});
    svg.words({foot.x, foot.y + 15.0}, across.text(tick), TextAnchor::middle, paper::kQuiet, 11.0);
  }
  const AxisTicks up = axisTicks(frame.low_mm.y, frame.high_mm.y, 5, false);
  for (const double tick : up.at) {
    glm::dvec3 p = frame.low_mm;
    p.y = tick;
    const double y = frame.at(view, left, p).y;
    svg.line({left, y}, {left + width, y}, {paper::kFaint, tick == 0.0 ? 1.6 : 0.7});
    svg.words({left - 6.0, y + 4.0}, up.text(tick), TextAnchor::end, paper::kQuiet, 11.0);
  }
  svg.words({left + 0.5 * width, kTop + height + 32.0}, view.across_label, TextAnchor::middle, paper::kInk, 11.5);
}

void drawTouches(Svg& svg, const Frame& frame, const View& view, double left, const std::vector<Residual>& touches,
                 double times, std::string_view colour, bool hollow) {
  for (const Residual& one : touches) {
    const glm::dvec2 at = frame.at(view, left, one.target_W.mm);
    if (!one.used) {
      svg.cross(at, 5.0, {paper::kOrange, 2.2});
      svg.words(at + glm::dvec2(8.0, 4.0), std::to_string(one.id), TextAnchor::start, paper::kOrange, 11.0, true);
      continue;
    }
    svg.disc(at, 2.4, hollow ? paper::kWhite : colour, {colour, 1.0});
    svg.arrow(at, frame.at(view, left, one.target_W.mm + times * one.error_mm.xyz), {colour, 1.4});
  }
}

void drawLegend(Svg& svg, double y, double px_per_mm, double times, bool has_held_out, bool has_outliers) {
  double x = kLeft;
  const double half_mm_long = 0.5 * times * px_per_mm;
  svg.arrow({x, y - 4.0}, {x + half_mm_long, y - 4.0}, {paper::kInk, 1.4});
  const std::string scale = "0.5 mm (arrows " + fixedText(times, 0) + " times as long)";
  svg.words({x + half_mm_long + 8.0, y}, scale, TextAnchor::start, paper::kInk, 11.5);
  x += half_mm_long + 250.0;
  svg.disc({x, y - 4.0}, 2.4, paper::kWhite, {paper::kQuiet, 1.0});
  svg.words({x + 8.0, y}, "fitted", TextAnchor::start, paper::kInk, 11.5);
  x += 70.0;
  if (has_held_out) {
    svg.disc({x, y - 4.0}, 2.4, paper::kBlue);
    svg.words({x + 8.0, y}, "held out", TextAnchor::start, paper::kInk, 11.5);
    x += 85.0;
  }
  if (has_outliers) {
    svg.cross({x, y - 4.0}, 4.0, {paper::kOrange, 2.2});
    svg.words({x + 10.0, y}, "set aside, with its number", TextAnchor::start, paper::kInk, 11.5);
  }
}

}  // namespace

std::string residualViews(const std::vector<Residual>& fitted, const std::vector<Residual>& held_out) {
  const double times = enlargement(fitted, held_out);
  const Frame frame = frameOf(fitted, held_out, times);
  const double height = kTop + frame.px_per_mm * (frame.high_mm.y - frame.low_mm.y) + kBelow;
  Svg svg({kPage, height}, "Residual arrows at each touch, from the front and from the right");
  const double second = kLeft + frame.width(kFront) + kGap;
  const bool outliers = std::ranges::any_of(fitted, [](const Residual& one) { return !one.used; });
  for (const auto& [view, left] : {std::pair(kFront, kLeft), std::pair(kRight, second)}) {
    drawAxes(svg, frame, view, left);
    drawTouches(svg, frame, view, left, fitted, times, paper::kQuiet, true);
    drawTouches(svg, frame, view, left, held_out, times, paper::kBlue, false);
  }
  drawLegend(svg, height - 14.0, frame.px_per_mm, times, !held_out.empty(), outliers);
  return svg.markup();
}

}  // namespace app
