#include "app/procedure/root_canal/canal_tip.h"

#include <algorithm>
#include <cmath>

namespace app {

std::optional<CanalTip> canalTip(const assets::ToothCanals& tooth, const glm::dvec3& tip_P_mm) {
  constexpr double kIntoWall_mm = 0.5;
  std::optional<CanalTip> nearest;
  for (std::size_t n = 0; n < tooth.canals.size(); ++n) {
    const std::vector<assets::CanalPlace>& places = tooth.canals[n].places;
    for (std::size_t k = 1; k < places.size(); ++k) {
      const glm::dvec3 &a = places[k - 1].p_P_mm, way = places[k].p_P_mm - a;
      const double length_mm = std::max(glm::length(way), 1e-9);
      // Beyond the foramen it goes on as it came out.
      const double most = k + 1 == places.size() ? 1e9 : 1.0;
      const double t = std::clamp(glm::dot(tip_P_mm - a, way) / (length_mm * length_mm), 0.0, most);
      const double aside_mm = glm::distance(tip_P_mm, a + t * way);
      if (!nearest || aside_mm < nearest->aside_mm)
        nearest = CanalTip{n, places[k - 1].along_mm + t * (places[k].along_mm - places[k - 1].along_mm), aside_mm};
    }
  }
  if (!nearest || nearest->along_mm <= 0.0) return {};
  const assets::ToothCanal& canal = tooth.canals[nearest->canal];
  const double wide_mm = canal.at(std::min(nearest->along_mm, canal.length_mm())).wide_mm;
  return nearest->aside_mm <= wide_mm + kIntoWall_mm ? nearest : std::nullopt;
}

}  // namespace app
