#include "app/calibrate/report/error_map_view.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/report/axis_ticks.h"
#include "app/report/svg.h"

namespace app {
namespace {

using calibration::Point;
using calibration::World;

constexpr glm::dvec2 kHalf_mm{80.0, 60.0};
constexpr double kCell_mm = 2.0, kPxPerMm = 3.2, kLeft = 50.0, kTop = 26.0, kBelow = 46.0, kScale = 150.0;

/// Light is small; steps that stay apart in grey. After ColorBrewer's Blues (Brewer 2003).
constexpr std::array<std::string_view, 7> kBands = {"#eff3ff", "#c6dbef", "#9ecae1", "#6baed6",
                                                    "#4292c6", "#2171b5", "#084594"};

struct Bands {
  double low_mm = 0.0, step_mm = 0.05;

  std::size_t of(double mm) const {
    const double band = std::floor((mm - low_mm) / step_mm + 1e-9);
    return static_cast<std::size_t>(std::clamp(band, 0.0, static_cast<double>(kBands.size() - 1)));
  }
};

/// So that all that is there fits into the bands, with numbers that read well.
Bands bandsFor(double least_mm, double most_mm) {
  for (const double step_mm : {0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0}) {
    const double low_mm = step_mm * std::floor(least_mm / step_mm + 1e-9);
    if (low_mm + step_mm * static_cast<double>(kBands.size()) >= most_mm) return {low_mm, step_mm};
  }
  return {0.0, 10.0};
}

glm::dvec2 placed(double x_mm, double y_mm) {
  return {kLeft + kPxPerMm * (x_mm + kHalf_mm.x), kTop + kPxPerMm * (kHalf_mm.y - y_mm)};
}

void drawField(Svg& svg, const ExpectedError& expected_mm, const Bands& bands) {
  // Cells of one band in a row are one box.
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
      // A hair over, so that no white shows between.
      svg.box(placed(-kHalf_mm.x + from * kCell_mm, y_mm + 0.5 * kCell_mm),
              {kPxPerMm * kCell_mm * (to - from) + 0.4, kPxPerMm * kCell_mm + 0.4}, kBands[band]);
    }
  }
}

void drawAxes(Svg& svg) {
  const glm::dvec2 corner = placed(-kHalf_mm.x, kHalf_mm.y), foot = placed(kHalf_mm.x, -kHalf_mm.y);
  svg.box(corner, foot - corner, paper::kNone, {paper::kQuiet, 1.0});
  for (const double x_mm : {-80.0, -40.0, 0.0, 40.0, 80.0})
    svg.words({placed(x_mm, 0.0).x, foot.y + 16.0}, fixedText(x_mm, 0), TextAnchor::middle, paper::kQuiet, 11.0);
  for (const double y_mm : {-60.0, -30.0, 0.0, 30.0, 60.0})
    svg.words({kLeft - 6.0, placed(0.0, y_mm).y + 4.0}, fixedText(y_mm, 0), TextAnchor::end, paper::kQuiet, 11.0);
  svg.words({0.5 * (corner.x + foot.x), foot.y + 34.0}, "x, to the right / mm", TextAnchor::middle, paper::kInk, 11.5);
  svg.words({kLeft, kTop - 9.0}, "y, upwards / mm", TextAnchor::start, paper::kInk, 11.5);
}

void drawScale(Svg& svg, const Bands& bands, std::size_t used) {
  const double x = placed(kHalf_mm.x, 0.0).x + 30.0, step = 24.0;
  const int digits = bands.step_mm < 0.1 ? 2 : 1;
  double y = kTop + 24.0;
  svg.words({x, kTop + 8.0}, "expected error / mm", TextAnchor::start, paper::kInk, 11.5);
  for (std::size_t band = 0; band < used; ++band, y += step) {
    svg.box({x, y}, {26.0, step}, kBands[band], {paper::kQuiet, 0.6});
    const double low_mm = bands.low_mm + bands.step_mm * static_cast<double>(band);
    svg.words({x + 34.0, y + 0.5 * step + 4.0},
              fixedText(low_mm, digits) + " to " + fixedText(low_mm + bands.step_mm, digits), TextAnchor::start,
              paper::kInk, 11.0);
  }
  svg.disc({x + 13.0, y + 20.0}, 3.2, paper::kWhite, {paper::kInk, 1.2});
  svg.words({x + 34.0, y + 24.0}, "touches", TextAnchor::start, paper::kInk, 11.0);
}

}  // namespace

std::string errorMapView(const ExpectedError& expected_mm, const std::vector<Point<World>>& touches_W) {
  double least_mm = 1e9, most_mm = 0.0;
  for (double x_mm = -kHalf_mm.x; x_mm <= kHalf_mm.x; x_mm += 4.0)
    for (double y_mm = -kHalf_mm.y; y_mm <= kHalf_mm.y; y_mm += 4.0) {
      const double mm = expected_mm({{x_mm, y_mm, 0.0}});
      least_mm = std::min(least_mm, mm);
      most_mm = std::max(most_mm, mm);
    }
  const Bands bands = bandsFor(least_mm, most_mm);
  const glm::dvec2 foot = placed(kHalf_mm.x, -kHalf_mm.y);
  Svg svg({foot.x + kScale, foot.y + kBelow}, "Error to be expected over the plane through the site");
  drawField(svg, expected_mm, bands);
  for (const Point<World>& touch : touches_W)
    if (std::abs(touch.mm.x) < kHalf_mm.x && std::abs(touch.mm.y) < kHalf_mm.y)
      svg.disc(placed(touch.mm.x, touch.mm.y), 3.2, paper::kWhite, {paper::kInk, 1.2});
  drawAxes(svg);
  drawScale(svg, bands, bands.of(most_mm) + 1);
  return svg.markup();
}

}  // namespace app
