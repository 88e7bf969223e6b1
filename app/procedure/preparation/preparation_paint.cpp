#include "app/procedure/preparation/preparation_paint.h"

#include <array>
#include <cmath>
#include <numbers>

#include <fmt/core.h>

#include "app/procedure/preparation/deviation_colour.h"
#include "app/procedure/preparation/made_surface.h"

namespace app {
namespace {

constexpr glm::dvec3 kUndercut(0.49, 0.12, 0.50), kWay(0.98, 0.91, 0.35);
constexpr glm::dvec3 kDrawnLine(0.24, 0.26, 0.31);
constexpr double kArrow_mm = 4.0;

/// Where the way through the middle of the stump meets it, from the bite.
glm::dvec3 stumpTop_P_mm(const Crown& crown, const BoxBytes& made, const glm::dvec3& way_P) {
  const double step_mm = 0.5 * made.grid().spacing_mm;
  const glm::dvec3 foot_P = crown.frame.inP({0.0, 0.0, 0.0});
  double mm = crown.top_mm + 1.0;
  while (mm > 0.0 && made.at(foot_P + mm * way_P) < 0.5) mm -= step_mm;
  return foot_P + mm * way_P;
}

render::SurfacePaint::Row row(const glm::dvec3& srgb, std::string means) {
  return {render::linearFromSrgb(glm::vec3(srgb)), std::move(means)};
}

}  // namespace

PreparationPaint preparationPaint(const PreparationMeasure& measure, const BoxBytes& made,
                                  const PreparationOutcomes& outcomes) {
  PreparationPaint paint;
  paint.box = made.grid();
  PaintBrush deviation(paint.box);
  for (const DeviationPlace& place : outcomes.deviation.places)
    deviation.lay(glm::dvec3(place.p_P_mm), deviationColour(static_cast<double>(place.deviation_mm)));
  paint.deviation = deviation.spots();
  // Before there are walls there is no way over them.
  if (!outcomes.insertion || !outcomes.walls || !std::isfinite(outcomes.walls->convergence_rad)) return paint;
  const glm::dvec3 way_P = wayOf(*outcomes.insertion, measure.crown().frame);
  PaintBrush undercut(paint.box);
  for (const glm::dvec3& p_P : undercutPlaces_P_mm(measure.crown(), *outcomes.stump, outcomes.deviation.places, way_P))
    undercut.lay(p_P, kUndercut);
  paint.undercut = undercut.spots();
  const glm::dvec3 tip_P = stumpTop_P_mm(measure.crown(), *outcomes.stump, way_P);
  paint.arrow = render::GuideArrow{{tip_P + kArrow_mm * way_P}, {tip_P}};
  const double degrees = outcomes.insertion->off_axis_rad * 180.0 / std::numbers::pi;
  paint.way = degrees < 0.05 ? "way of insertion: the tooth's axis"
                             : fmt::format("way of insertion {:.1f}° off the axis", degrees);
  // What is less than the voxels' roughness is not shown either.
  paint.hindered =
      paint.undercut.empty() ? "no undercut" : fmt::format("undercut {:.2f} mm³", outcomes.insertion->undercut_mm3);
  return paint;
}

PaintSpots outlineSpots(const Crown& crown, const PreparedIdeal& ideal) {
  constexpr double kHalfLine_mm = 0.1;
  PaintBrush brush(crown.solid.grid());
  forSurface(
      crown.solid, [&](glm::ivec3 ijk, glm::ivec3) { return crown.isTooth(ijk); },
      [&](const SurfacePlace& place) {
        const glm::dvec3 p = crown.frame.local(place.p_P_mm);
        if (p.z > 0.0 && std::abs(ideal.depth_mm(p)) < kHalfLine_mm) brush.lay(place.p_P_mm, kDrawnLine);
      });
  return brush.spots();
}

std::vector<render::SurfacePaint::Row> outlineRows() { return {row(kDrawnLine, "outline of the task")}; }

std::vector<render::SurfacePaint::Row> deviationRows() {
  std::vector<render::SurfacePaint::Row> rows;
  for (const auto& [mm, means] : std::array<std::pair<double, const char*>, 5>{{{kFullColour_mm, "0.5 mm too high"},
                                                                                {0.5 * kFullColour_mm, "0.25"},
                                                                                {0.0, "as planned"},
                                                                                {-0.5 * kFullColour_mm, "0.25"},
                                                                                {-kFullColour_mm, "0.5 mm too deep"}}})
    rows.push_back(row(deviationColour(mm), means));
  return rows;
}

std::vector<render::SurfacePaint::Row> insertionRows(const PreparationPaint& paint) {
  if (paint.way.empty()) return {};
  return {row(kWay, paint.way), row(kUndercut, paint.hindered)};
}

}  // namespace app
