#include "app/calibrate/report/report_views.h"

#include <algorithm>
#include <array>

#include "app/report/axes.h"
#include "app/report/markup.h"

namespace app {
namespace {

using calibration::Residual;

constexpr double kMaxHeight = 280.0, kLeft = 46.0, kGap = 60.0, kLegend = 26.0, kPage = 760.0;
constexpr double kUsual = 50.0, kForLarge = 10.0, kLarge_mm = 1.2, kMinHalf_mm = 30.0;
constexpr double kDot = 2.4, kArrow = 1.4, kCross = 5.0, kHeavy = 2.2;

/// One view: a coordinate of W across, y upwards.
struct View {
  int across = 0;
  Axes axes;

  glm::dvec2 at(const glm::dvec3& p) const { return axes.at({p[across], p.y}); }
};

double enlargement(const std::vector<Residual>& a, const std::vector<Residual>& b) {
  double longest_mm = 0.0;
  for (const auto* list : {&a, &b})
    for (const Residual& one : *list)
      if (one.used) longest_mm = std::max(longest_mm, glm::length(one.error_mm.xyz));
  return longest_mm > kLarge_mm ? kForLarge : kUsual;
}

/// The same scale in both views.
std::array<View, 2> viewsOf(const std::vector<Residual>& fitted, const std::vector<Residual>& held_out, double times) {
  glm::dvec3 low_mm(-kMinHalf_mm), high_mm(kMinHalf_mm);
  for (const auto* list : {&fitted, &held_out})
    for (const Residual& one : *list)
      for (const glm::dvec3& p : {one.target_W.mm, one.target_W.mm + (one.used ? times : 0.0) * one.error_mm.xyz}) {
        low_mm = glm::min(low_mm, p);
        high_mm = glm::max(high_mm, p);
      }
  low_mm -= 6.0, high_mm += 6.0;
  const glm::dvec3 size_mm = high_mm - low_mm;
  const double scale = std::min(kMaxHeight / size_mm.y, (kPage - 2.0 * kLeft - kGap) / (size_mm.x + size_mm.z));
  const auto axis = [&](int n, const char* label) { return axisOf(axisTicks(low_mm[n], high_mm[n], 5, false), label); };
  const Axis up = axis(1, "y, upwards / mm");
  View front{
      0, {{kLeft, Axes::kAbove}, scale * glm::dvec2(size_mm), axis(0, "x, to the right / mm"), up, "From the front"}};
  View right{2,
             {{front.axes.foot().x + kGap, Axes::kAbove},
              scale * glm::dvec2(size_mm.z, size_mm.y),
              axis(2, "z, towards the viewer / mm"),
              up,
              "From the right"}};
  std::swap(right.axes.x.from, right.axes.x.to);
  return {front, right};
}

void drawTouches(const Drawing& drawing, const View& view, const std::vector<Residual>& touches, double times,
                 const Ink& ink, bool hollow) {
  for (const Residual& one : touches) {
    const glm::dvec2 at = view.at(one.target_W.mm);
    if (!one.used) {
      drawing.cross(at, kCross, kHeavy, paper::kOrange);
      drawing.text(std::to_string(one.id), at + glm::dvec2(8.0, 0.0), kNumberLine, paper::kOrange, Align::left, true);
      continue;
    }
    drawing.disc(at, kDot, hollow ? paper::kWhite : ink);
    drawing.circle(at, kDot, 1.0, ink);
    drawing.arrow(at, view.at(one.target_W.mm + times * one.error_mm.xyz), kArrow, ink);
  }
}

}  // namespace

std::string residualViews(const std::vector<Residual>& fitted, const std::vector<Residual>& held_out) {
  const double times = enlargement(fitted, held_out);
  const std::array<View, 2> views = viewsOf(fitted, held_out, times);
  const double foot = views[0].axes.foot().y + Axes::kBelow;
  Drawing drawing({kPage, foot + kLegend});
  for (const View& view : views) {
    view.axes.draw(drawing);
    drawTouches(drawing, view, fitted, times, paper::kQuiet, true);
    drawTouches(drawing, view, held_out, times, paper::kBlue, false);
  }

  const double half_mm_long = glm::distance(views[0].at({0.5 * times, 0.0, 0.0}), views[0].at(glm::dvec3(0.0)));
  const glm::dvec2 to_middle(kDot, 0.0);
  std::vector<LegendEntry> entries{
      {"0.5 mm (arrows " + fixedText(times, 0) + " times as long)", half_mm_long,
       [&](auto& left) { drawing.arrow(left, left + glm::dvec2(half_mm_long, 0.0), kArrow, paper::kInk); }},
      {"fitted", 2.0 * kDot, [&](auto& left) { drawing.circle(left + to_middle, kDot, 1.0, paper::kQuiet); }}};
  if (!held_out.empty())
    entries.push_back(
        {"held out", 2.0 * kDot, [&](auto& left) { drawing.disc(left + to_middle, kDot, paper::kBlue); }});
  if (std::ranges::any_of(fitted, [](const Residual& one) { return !one.used; }))
    entries.push_back({"set aside, with its number", 2.0 * kCross, [&](auto& left) {
                         drawing.cross(left + glm::dvec2(kCross, 0.0), 0.8 * kCross, kHeavy, paper::kOrange);
                       }});
  legend(drawing, entries, {0.5 * kPage, foot + 4.0}, kPage);
  return drawing.markup("Residual arrows at each touch, from the front and from the right");
}

}  // namespace app
