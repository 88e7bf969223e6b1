#include "app/report/chart.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/report/axes.h"

namespace app {
namespace {

/// 300 dpi; a unit is 1/120 inch.
constexpr double kPxPerUnit = 2.5, kMargin = 14.0, kTitle = 17.0;
/// Okabe and Ito 2008, without the yellow, which is too pale for a line.
constexpr std::array kColours = {paper::kBlue,  paper::kOrange,  paper::kGreen,  inkOf(0xcc79a7),
                                 paper::kAmber, inkOf(0x56b4e9), inkOf(0x1a1a1a)};
constexpr double kLine = 1.8, kThin = 1.2, kDot = 2.8;

const Ink& inkOf(const Curve& curve) { return kColours[static_cast<std::size_t>(curve.colour) % kColours.size()]; }
Dashes dashesOf(const Curve& curve) { return curve.dashed ? Dashes{5.6, 3.6} : Dashes{}; }

/// Range of all finite points, bars and reference lines.
glm::dvec2 rangeOf(const Panel& panel, int axis) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  const auto take = [&](double v) {
    if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
  };
  for (const Curve& curve : panel.curves) {
    for (const glm::dvec2& p : curve.points) take(p[axis]);
    if (axis == 1)
      for (const glm::dvec2& bar : curve.bars) take(bar.x), take(bar.y);
  }
  for (const ReferenceLine& line : panel.lines)
    if (line.across == (axis == 1)) take(line.at);
  if (!(high > low)) low = std::isfinite(low) ? low - 0.5 : 0.0, high = low + 1.0;
  return {low, high};
}

/// A panel between two corners, labels included.
Axes axesOf(const Drawing& drawing, const Panel& panel, const glm::dvec2& corner, const glm::dvec2& foot) {
  const glm::dvec2 x = panel.x_range.value_or(rangeOf(panel, 0)), y = panel.y_range.value_or(rangeOf(panel, 1));
  Axes axes{{},
            {},
            axisOf(axisTicks(x.x, x.y, 6, !panel.x_range), panel.x_label),
            axisOf(axisTicks(y.x, y.y, 6, !panel.y_range), panel.y_label),
            panel.title};
  double widest = 0.0;
  for (const Axis::Mark& mark : axes.y.marks) widest = std::max(widest, drawing.textWidth(mark.text, kNumberLine));
  axes.corner = corner + glm::dvec2(widest + 8.0, Axes::kAbove);
  axes.size = foot - glm::dvec2(8.0, Axes::kBelow) - axes.corner;
  return axes;
}

void drawCurve(const Drawing& drawing, const Axes& axes, const Curve& curve) {
  const Ink& ink = inkOf(curve);
  std::vector<glm::dvec2> points;
  for (const glm::dvec2& p : curve.points) points.push_back(axes.at(p));
  for (std::size_t i = 0; i < curve.bars.size() && i < points.size(); ++i) {
    const double x = curve.points[i].x;
    drawing.line(axes.at({x, curve.bars[i].x}), axes.at({x, curve.bars[i].y}), kThin, ink);
  }
  if (curve.joined) drawing.path(points, kLine, ink, false, dashesOf(curve));
  if (!curve.dotted) return;
  for (std::size_t i = 0; i < points.size(); ++i)
    drawing.disc(points[i], kDot * (i < curve.sizes.size() ? curve.sizes[i] : 1.0), ink);
}

/// The label of a line on white, at the position along the line that hides the fewest points.
void drawLineLabel(const Drawing& drawing, const Axes& axes, const Panel& panel, const ReferenceLine& line) {
  if (line.label.empty()) return;
  const glm::dvec2 low = axes.corner, high = axes.foot();
  const glm::dvec2 at = axes.at(line.across ? glm::dvec2(axes.x.to, line.at) : glm::dvec2(line.at, axes.y.to));
  const glm::dvec2 size{drawing.textWidth(line.label, kNumberLine), kNumberLine};
  std::vector<glm::dvec2> places;
  if (line.across)
    for (const double y : {at.y - size.y - 1.5, at.y + 1.5})
      for (const double x : {high.x - 4.0 - size.x, low.x + 5.0}) places.emplace_back(x, y);
  else
    for (const double x : {at.x + 4.0, at.x - 4.0 - size.x})
      for (const double y : {low.y + 2.0, high.y - size.y - 2.0}) places.emplace_back(x, y);
  const auto hidden = [&](const glm::dvec2& corner) {
    std::ptrdiff_t points = 0;
    for (const Curve& curve : panel.curves)
      points += std::ranges::count_if(curve.points, [&](const glm::dvec2& p) {
        const glm::dvec2 from_corner = axes.at(p) - corner;
        return glm::all(glm::greaterThan(from_corner, glm::dvec2(0.0))) && glm::all(glm::lessThan(from_corner, size));
      });
    return points;
  };
  const glm::dvec2 best = *std::ranges::min_element(places, {}, hidden);
  drawing.box(best - glm::dvec2(1.5, 0.0), size + glm::dvec2(3.0, 0.0), paper::kWhite);
  drawing.text(line.label, best + glm::dvec2(0.0, 0.5 * size.y), kNumberLine, paper::kQuiet, Align::left);
}

void drawPanel(const Drawing& drawing, const Panel& panel, const Axes& axes) {
  axes.draw(drawing);
  for (const ReferenceLine& line : panel.lines) {
    const glm::dvec2 from = axes.at(line.across ? glm::dvec2(axes.x.from, line.at) : glm::dvec2(line.at, axes.y.from));
    const glm::dvec2 to = axes.at(line.across ? glm::dvec2(axes.x.to, line.at) : glm::dvec2(line.at, axes.y.to));
    drawing.line(from, to, kThin, paper::kQuiet, {5.6, 3.6});
  }
  drawing.inside(axes.corner - 3.0, axes.size + 6.0, [&] {
    for (const Curve& curve : panel.curves) drawCurve(drawing, axes, curve);
  });
  for (const ReferenceLine& line : panel.lines) drawLineLabel(drawing, axes, panel, line);
}

/// One entry per label.
std::vector<LegendEntry> entriesOf(const Drawing& drawing, const Chart& chart) {
  constexpr double kSample = 26.0;
  std::vector<LegendEntry> entries;
  for (const Panel& panel : chart.panels)
    for (const Curve& curve : panel.curves) {
      if (curve.label.empty() || std::ranges::find(entries, curve.label, &LegendEntry::label) != entries.end())
        continue;
      entries.push_back({curve.label, kSample, [&](const glm::dvec2& left) {
                           if (curve.joined)
                             drawing.line(left, left + glm::dvec2(kSample, 0.0), kLine, inkOf(curve), dashesOf(curve));
                           if (curve.dotted) drawing.disc(left + glm::dvec2(0.5 * kSample, 0.0), kDot, inkOf(curve));
                         }});
    }
  return entries;
}

}  // namespace

void drawChart(const Chart& chart, calibration::OutputFile& file) {
  const Drawing drawing(glm::ivec2(glm::round(kPxPerUnit * chart.size)), kPxPerUnit);
  drawing.fill(paper::kWhite);
  const double width = chart.size.x - 2.0 * kMargin;
  drawing.text(chart.title, {kMargin, 20.0}, kTitle, paper::kInk, Align::left, true);
  const double caption =
      drawing.paragraph(chart.caption, {kMargin, 32.0}, width, kNumberLine, paper::kQuiet, Align::left);

  const std::vector<LegendEntry> entries = entriesOf(drawing, chart);
  const double top = 40.0 + caption;
  const double bottom = chart.size.y - legend(drawing, entries, {}, width, false) - 8.0;
  const double gap = 14.0, count = static_cast<double>(chart.panels.size());
  const double panel_width = (width - gap * (count - 1.0)) / count;
  double left = kMargin;
  for (const Panel& panel : chart.panels) {
    drawPanel(drawing, panel, axesOf(drawing, panel, {left, top}, {left + panel_width, bottom}));
    left += panel_width + gap;
  }
  legend(drawing, entries, {0.5 * chart.size.x, bottom}, width);
  drawing.save(file);
}

}  // namespace app
