#include "assets/synthetic/root_canal.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace assets {
namespace {

constexpr double degrees(double d) { return d * std::numbers::pi / 180.0; }

double lengthOf(const glm::dvec3& v) { return std::sqrt(glm::dot(v, v)); }

}  // namespace

double RootCanal::radius_mm(double along_mm) const {
  const double share = std::clamp(along_mm / length_mm(), 0.0, 1.0);
  return orifice_radius_mm + (apex_radius_mm - orifice_radius_mm) * share;
}

RootCanal::Place RootCanal::at(double along_mm) const {
  if (along_mm <= straight_mm) return {{0.0, 0.0, -along_mm}, {0.0, 0.0, -1.0}};
  const double R = arc_radius_mm, turned = std::min((along_mm - straight_mm) / R, arc_rad);
  const glm::dvec3 along(std::sin(turned), 0.0, -std::cos(turned));
  const glm::dvec3 p_mm(R * (1.0 - std::cos(turned)), 0.0, -straight_mm - R * std::sin(turned));
  return {p_mm + std::max(0.0, along_mm - straight_mm - R * arc_rad) * along, along};
}

double RootCanal::nearest_mm(const glm::dvec3& p_mm) const {
  // One candidate on each of the three parts.
  const double bent_mm = straight_mm + arc_radius_mm * arc_rad;
  const Place end = at(bent_mm);
  const double turned = std::atan2(-(p_mm.z + straight_mm), arc_radius_mm - p_mm.x);
  double best_mm = 0.0, least_mm = lengthOf(p_mm);
  for (const double along_mm :
       {std::clamp(-p_mm.z, 0.0, straight_mm), straight_mm + arc_radius_mm * std::clamp(turned, 0.0, arc_rad),
        bent_mm + std::clamp(glm::dot(p_mm - end.p_mm, end.along), 0.0, apical_mm)}) {
    const double away_mm = lengthOf(p_mm - at(along_mm).p_mm);
    if (away_mm < least_mm) least_mm = away_mm, best_mm = along_mm;
  }
  return best_mm;
}

double RootCanal::depth_mm(const glm::dvec3& p_mm) const {
  const double along_mm = nearest_mm(p_mm);
  const Place place = at(along_mm);
  const glm::dvec3 away = p_mm - place.p_mm;
  // Both ends are open: beyond them only the way from the axis counts.
  const double beyond_mm = std::max(glm::dot(away, place.along) * (along_mm > 0.0 ? 1.0 : -1.0), 0.0);
  const double aside_mm = lengthOf(away - glm::dot(away, place.along) * place.along);
  const double within_mm = std::min(aside_mm - radius_mm(along_mm), radius_mm(along_mm) + wall_mm - aside_mm);
  const double cut_mm = std::min(within_mm, along_mm <= 0.0 ? -beyond_mm : wall_mm - beyond_mm);
  // The edge of the orifice is round.
  const double down_mm = flare_mm + p_mm.z, out_mm = radius_mm(flare_mm) + flare_mm - std::hypot(p_mm.x, p_mm.y);
  if (flare_mm <= 0.0 || along_mm > flare_mm || down_mm <= 0.0 || out_mm <= 0.0) return cut_mm;
  return flare_mm - std::hypot(down_mm, out_mm);
}

double RootCanal::schneider_rad() const {
  const double R = arc_radius_mm, across = R * (1.0 - std::cos(arc_rad)) + apical_mm * std::sin(arc_rad);
  return std::atan2(across, R * std::sin(arc_rad) + apical_mm * std::cos(arc_rad));
}

CanalField canalField(const RootCanal& canal, double spacing_mm) {
  const double aside_mm = std::max(canal.orifice_radius_mm, canal.apex_radius_mm) + canal.wall_mm + 3.0 * spacing_mm;
  const RootCanal::Place apex = canal.at(canal.length_mm());
  const glm::dvec3 low(-aside_mm, -aside_mm, apex.p_mm.z - aside_mm),
      high(apex.p_mm.x + aside_mm, aside_mm, 3.0 * spacing_mm);
  CanalField field;
  field.grid.spacing_mm = spacing_mm;
  field.grid.origin_P_mm = low;
  field.grid.size = glm::ivec3(glm::ceil((high - low) / spacing_mm)) + 1;
  field.solid.resize(field.grid.voxelCount());
  forVoxels(field.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const double depth_mm = canal.depth_mm(field.grid.centre_P_mm(ijk));
    field.solid[v] = static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(0.5 + depth_mm / spacing_mm, 0.0, 1.0)));
  });
  return field;
}

}  // namespace assets
