#include "app/procedure/preparation/groove_script.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/gtc/quaternion.hpp>

#include "app/procedure/preparation/prepared_ideal.h"

namespace app {
namespace {

/// Towards the cheek, in order; and how far a groove reaches to either side of the tooth's middle.
constexpr std::array kGroovesAcross_mm{0.0, 1.6, -1.6};
constexpr double kGrooveHalf_mm = 2.0, kGrooveStep_mm = 0.2;
constexpr double kGrooveOver_mm = 0.4, kGrooveDeep_mm = 1.6,
                 kGroovePass_mm = 0.08;  ///< of the end: over the surface, below it, each pass
constexpr double kGrooveCut_mm_per_s = 3.0, kGrooveAir_mm_per_s = 40.0, kGrooveClear_mm = 2.0;

/// The highest of the biting surface under a head.
double surfaceUnder_mm(const OcclusalMap& map, const glm::dvec2& at_mm, double radius_mm) {
  double highest_mm = map.at(at_mm);
  for (const glm::dvec2 side :
       {glm::dvec2(1.0, 0.0), glm::dvec2(-1.0, 0.0), glm::dvec2(0.0, 1.0), glm::dvec2(0.0, -1.0)})
    highest_mm = std::max(highest_mm, map.at(at_mm + radius_mm * side));
  return highest_mm;
}

}  // namespace

HandScript grooveScript(const Crown& crown, std::span<const haptics::Tool> tray) {
  double half_mm = 0.0, radius_mm = 0.0;
  for (const haptics::Tool& tool : tray) {
    if (!tool.turns()) continue;
    half_mm = std::max(half_mm, haptics::halfHeight_mm(tool.head));
    radius_mm = std::max(radius_mm, tool.head.radius_mm);
  }
  const OcclusalMap map(crown);
  const glm::dvec3 up(0.0, 0.0, 1.0);
  const glm::dquat upright(up, crown.frame.axes_P * up);
  HandScript script;
  double t_s = 0.0;
  glm::dvec3 from_mm(0.0);
  const auto go = [&](const glm::dvec3& end_mm, double mm_per_s, bool turns) {
    constexpr double kLeast_s = 0.002;
    if (!script.poses.empty()) {
      t_s += std::max(kLeast_s, glm::distance(end_mm, from_mm) / mm_per_s);
      script.poses.back().pedal = turns;
    }
    const glm::dvec3 middle_P = crown.frame.inP(end_mm + glm::dvec3(0.0, 0.0, half_mm));
    script.poses.push_back({t_s, {glm::normalize(upright), middle_P}, turns, 0u});
    from_mm = end_mm;
  };
  const double clear_mm = crown.top_mm + kGrooveClear_mm;
  const int steps = static_cast<int>(std::lround(2.0 * kGrooveHalf_mm / kGrooveStep_mm));
  for (const double across_mm : kGroovesAcross_mm) {
    go({-kGrooveHalf_mm, across_mm, clear_mm}, kGrooveAir_mm_per_s, false);
    double way = 1.0;
    for (double sunk_mm = -kGrooveOver_mm; sunk_mm < kGrooveDeep_mm; sunk_mm += kGroovePass_mm, way = -way)
      for (int n = 0; n <= steps; ++n) {
        const glm::dvec2 at_mm(way * (n * kGrooveStep_mm - kGrooveHalf_mm), across_mm);
        go({at_mm, surfaceUnder_mm(map, at_mm, radius_mm) - sunk_mm}, kGrooveCut_mm_per_s, true);
      }
    go({from_mm.x, across_mm, clear_mm}, kGrooveAir_mm_per_s, false);
  }
  return script;
}

}  // namespace app
