#include "app/report/axes.h"

#include <algorithm>
#include <cmath>

#include "app/report/markup.h"

namespace app {

AxisTicks axisTicks(double low, double high, int wanted, bool whole) {
  if (!(std::isfinite(low) && std::isfinite(high)) || !(high > low)) low = 0.0, high = 1.0;
  AxisTicks ticks;
  const double raw = (high - low) / std::max(1, wanted);
  const double decade = std::pow(10.0, std::floor(std::log10(raw)));
  ticks.step = 10.0 * decade;
  for (const double factor : {5.0, 2.0, 1.0})
    if (factor * decade >= raw * (1.0 - 1e-9)) ticks.step = factor * decade;
  const double slack = 1e-9 * ticks.step;
  const double first = whole ? std::floor((low + slack) / ticks.step) : std::ceil((low - slack) / ticks.step);
  const double last = whole ? std::ceil((high - slack) / ticks.step) : std::floor((high + slack) / ticks.step);
  ticks.low = whole ? first * ticks.step : low;
  ticks.high = whole ? last * ticks.step : high;
  for (double n = first; n <= last; n += 1.0) ticks.at.push_back(n == 0.0 ? 0.0 : n * ticks.step);
  return ticks;
}

std::string AxisTicks::text(double value) const {
  const int digits = std::clamp(static_cast<int>(-std::floor(std::log10(step) + 1e-9)), 0, 9);
  return fixedText(value, digits);
}

Axis axisOf(const AxisTicks& ticks, std::string label) {
  Axis axis{ticks.low, ticks.high, {}, std::move(label)};
  for (const double at : ticks.at) axis.marks.push_back({at, ticks.text(at)});
  return axis;
}

glm::dvec2 Axes::at(const glm::dvec2& value) const {
  const glm::dvec2 share{(value.x - x.from) / (x.to - x.from), (value.y - y.from) / (y.to - y.from)};
  return {corner.x + share.x * size.x, corner.y + (1.0 - share.y) * size.y};
}

void Axes::draw(const Drawing& drawing) const {
  const glm::dvec2 end = foot();
  const auto strength = [](double mark) { return mark == 0.0 ? 1.6 : 0.7; };
  for (const Axis::Mark& mark : y.marks) {
    const double height = at({x.from, mark.at}).y;
    drawing.line({corner.x, height}, {end.x, height}, strength(mark.at), paper::kFaint);
    drawing.text(mark.text, {corner.x - 6.0, height}, kNumberLine, paper::kQuiet, Align::right);
  }
  for (const Axis::Mark& mark : x.marks) {
    const double across = at({mark.at, y.from}).x;
    drawing.line({across, corner.y}, {across, end.y}, strength(mark.at), paper::kFaint);
    drawing.line({across, end.y}, {across, end.y + 4.0}, 1.0, paper::kQuiet);
    drawing.text(mark.text, {across, end.y + 12.0}, kNumberLine, paper::kQuiet);
  }
  drawing.outline(corner, size, 1.0, paper::kQuiet);
  drawing.text(title, corner - glm::dvec2(0.0, y.label.empty() ? 21.0 : 32.0), kTitleLine, paper::kInk, Align::left,
               true);
  drawing.text(y.label, corner - glm::dvec2(0.0, 13.0), kLabelLine, paper::kInk, Align::left);
  drawing.text(x.label, {0.5 * (corner.x + end.x), end.y + 29.0}, kLabelLine, paper::kInk);
}

double legend(const Drawing& drawing, const std::vector<LegendEntry>& entries, const glm::dvec2& top, double width,
              bool draws) {
  constexpr double kGap = 18.0, kBesideSample = 6.0, kRow = 18.0;
  const auto width_of = [&](const LegendEntry& entry) {
    return entry.sample_width + kBesideSample + drawing.textWidth(entry.label, kLabelLine);
  };
  double y = 0.0;
  for (std::size_t first = 0; first < entries.size(); y += kRow) {
    // As many entries as fit into this row.
    double row = width_of(entries[first]);
    std::size_t end = first + 1;
    for (; end < entries.size() && row + kGap + width_of(entries[end]) < width; ++end)
      row += kGap + width_of(entries[end]);
    glm::dvec2 at = top + glm::dvec2(-0.5 * row, y + 0.5 * kRow);
    for (; first < end; ++first) {
      const LegendEntry& entry = entries[first];
      if (draws) {
        entry.draw_sample(at);
        drawing.text(entry.label, at + glm::dvec2(entry.sample_width + kBesideSample, 0.0), kLabelLine, paper::kInk,
                     Align::left);
      }
      at.x += width_of(entry) + kGap;
    }
  }
  return y;
}

}  // namespace app
