#include "app/calibrate/report/report_views.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/report/axes.h"
#include "app/report/markup.h"

namespace app {
namespace {

using calibration::Point;
using calibration::World;

constexpr glm::dvec2 kHalf_mm{80.0, 60.0};
constexpr double kCell_mm = 2.0, kPxPerMm = 3.2, kLeft = 50.0, kTop = 26.0, kScale = 150.0, kDot = 3.2;

/// Light for small errors; distinct in grey. ColorBrewer's Blues (Brewer 2003).
constexpr std::array kBands = {inkOf(0xeff3ff), inkOf(0xc6dbef), inkOf(0x9ecae1), inkOf(0x6baed6),
                               inkOf(0x4292c6), inkOf(0x2171b5), inkOf(0x084594)};

struct Bands {
  double low_mm = 0.0, step_mm = 0.05;

  std::size_t of(double mm) const {
    const double band = std::floor((mm - low_mm) / step_mm + 1e-9);
    return static_cast<std::size_t>(std::clamp(band, 0.0, static_cast<double>(kBands.size() - 1)));
  }
};

/// The smallest round step whose bands cover the range.
Bands bandsFor(double min_mm, double max_mm) {
  for (const double step_mm : {0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0}) {
    const double low_mm = step_mm * std::floor(min_mm / step_mm + 1e-9);
    if (low_mm + step_mm * static_cast<double>(kBands.size()) >= max_mm) return {low_mm, step_mm};
  }
  return {0.0, 10.0};
}

void drawField(const Drawing& drawing, const Axes& axes, const ExpectedError& expected_mm, const Bands& bands) {
  // One box for neighbouring cells of a band.
  const int columns = static_cast<int>(2.0 * kHalf_mm.x / kCell_mm),
            rows = static_cast<int>(2.0 * kHalf_mm.y / kCell_mm);
  for (int row = 0; row < rows; ++row) {
    const double y_mm = kHalf_mm.y - (row + 0.5) * kCell_mm;
    const auto band_at = [&](int column) {
      return bands.of(expected_mm({{-kHalf_mm.x + (column + 0.5) * kCell_mm, y_mm, 0.0}}));
    };
    for (int from = 0, to = 0; from < columns; from = to) {
      const std::size_t band = band_at(from);
      for (to = from + 1; to < columns && band_at(to) == band; ++to) continue;
      // Slightly overlapping, so that no white shows between.
      drawing.box(axes.at({-kHalf_mm.x + from * kCell_mm, y_mm + 0.5 * kCell_mm}),
                  {kPxPerMm * kCell_mm * (to - from) + 0.4, kPxPerMm * kCell_mm + 0.4}, kBands[band]);
    }
  }
}

void drawTouch(const Drawing& drawing, const glm::dvec2& at) {
  drawing.disc(at, kDot, paper::kWhite);
  drawing.circle(at, kDot, 1.2, paper::kInk);
}

void drawScale(const Drawing& drawing, const Bands& bands, std::size_t used, const glm::dvec2& corner) {
  constexpr glm::dvec2 kBox{26.0, 24.0}, kToWords{34.0, 0.5 * kBox.y};
  const int digits = bands.step_mm < 0.1 ? 2 : 1;
  drawing.text("expected error / mm", corner + glm::dvec2(0.0, 4.0), kLabelLine, paper::kInk, Align::left);
  glm::dvec2 at = corner + glm::dvec2(0.0, kBox.y);
  for (std::size_t band = 0; band < used; ++band, at.y += kBox.y) {
    drawing.box(at, kBox, kBands[band]);
    drawing.outline(at, kBox, 0.6, paper::kQuiet);
    const double low_mm = bands.low_mm + bands.step_mm * static_cast<double>(band);
    drawing.text(fixedText(low_mm, digits) + " to " + fixedText(low_mm + bands.step_mm, digits), at + kToWords,
                 kNumberLine, paper::kInk, Align::left);
  }
  drawTouch(drawing, at + glm::dvec2(0.5 * kBox.x, 20.0));
  drawing.text("touches", at + glm::dvec2(kToWords.x, 20.0), kNumberLine, paper::kInk, Align::left);
}

}  // namespace

std::string errorMapView(const ExpectedError& expected_mm, const std::vector<Point<World>>& touches_W) {
  double min_mm = 1e9, max_mm = 0.0;
  for (double x_mm = -kHalf_mm.x; x_mm <= kHalf_mm.x; x_mm += 4.0)
    for (double y_mm = -kHalf_mm.y; y_mm <= kHalf_mm.y; y_mm += 4.0) {
      const double mm = expected_mm({{x_mm, y_mm, 0.0}});
      min_mm = std::min(min_mm, mm);
      max_mm = std::max(max_mm, mm);
    }
  const Bands bands = bandsFor(min_mm, max_mm);
  const Axes axes{{kLeft, kTop},
                  2.0 * kPxPerMm * kHalf_mm,
                  axisOf(axisTicks(-kHalf_mm.x, kHalf_mm.x, 8, false), "x, to the right / mm"),
                  axisOf(axisTicks(-kHalf_mm.y, kHalf_mm.y, 6, false), "y, upwards / mm"),
                  ""};
  Drawing drawing(axes.foot() + glm::dvec2(kScale, Axes::kBelow));
  axes.draw(drawing);
  drawField(drawing, axes, expected_mm, bands);
  for (const Point<World>& touch : touches_W)
    if (std::abs(touch.mm.x) < kHalf_mm.x && std::abs(touch.mm.y) < kHalf_mm.y) drawTouch(drawing, axes.at(touch.mm));
  drawing.outline(axes.corner, axes.size, 1.0, paper::kQuiet);
  drawScale(drawing, bands, bands.of(max_mm) + 1, {axes.foot().x + 30.0, axes.corner.y});
  return drawing.markup("Expected error over the plane through the site");
}

}  // namespace app
