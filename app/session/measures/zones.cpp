#include "app/session/measures/zones.h"

#include <limits>

namespace app {
namespace {

glm::dvec3 along(const std::array<glm::dvec3, 3>& axes_P, const glm::dvec3& p_P_mm) {
  return {glm::dot(axes_P[0], p_P_mm), glm::dot(axes_P[1], p_P_mm), glm::dot(axes_P[2], p_P_mm)};
}

}  // namespace

std::optional<Zones> Zones::around(const assets::VolumeGrid& grid, const std::function<bool(std::size_t)>& is_tooth,
                                   const CaseDirections& directions) {
  Zones zones;
  zones.axes_P_ = {directions.distal_P, directions.buccal_P, directions.up_P};
  glm::dvec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (!is_tooth(v)) return;
    const glm::dvec3 place_mm = along(zones.axes_P_, grid.centre_P_mm(ijk));
    low = glm::min(low, place_mm), high = glm::max(high, place_mm);
  });
  if (low.x > high.x) return {};
  zones.centre_mm_ = 0.5 * (low + high);
  zones.half_mm_ = glm::max(0.5 * (high - low), glm::dvec3(grid.spacing_mm));
  return zones;
}

Zone Zones::at(const glm::dvec3& p_P_mm) const {
  const glm::dvec3 out = (along(axes_P_, p_P_mm) - centre_mm_) / half_mm_, far = glm::abs(out);
  if (far.z >= far.x && far.z >= far.y) return out.z > 0.0 ? Zone::occlusal : Zone::apical;
  if (far.y >= far.x) return out.y > 0.0 ? Zone::buccal : Zone::lingual;
  return out.x > 0.0 ? Zone::distal : Zone::mesial;
}

std::optional<Zones> zonesOfCase(const StoredStart& start, const SessionCase& about) {
  if (!about.directions) return {};
  const int fdi = start.setup.site ? start.setup.site->fdi : 0;
  return Zones::around(
      start.grid,
      [&](std::size_t v) {
        return start.is_tooth.empty() ? fdi != 0 && !start.teeth.empty() && start.teeth[v] == fdi
                                      : start.is_tooth[v] != 0;
      },
      *about.directions);
}

}  // namespace app
