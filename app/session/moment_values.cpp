#include "app/session/moment_values.h"

#include <numeric>

#include <fmt/core.h>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

namespace app {

MomentValues valuesOf(const haptics::Tick& tick) {
  MomentValues values;
  values.tick = tick.index, values.t_s = tick.t_s, values.bone_digest = tick.bone_digest;
  values.force_N = glm::length(tick.commanded_force_P_N.xyz);
  values.removed_mm3 = std::accumulate(tick.removed_total_mm3.begin(), tick.removed_total_mm3.end(), 0.0);
  return values;
}

std::string momentJson(const MomentValues& values) {
  return nlohmann::ordered_json{{"tick", values.tick},
                                {"t_s", values.t_s},
                                {"force_N", values.force_N},
                                {"removed_mm3", values.removed_mm3},
                                {"bone_digest", fmt::format("{:016x}", values.bone_digest)}}
      .dump();
}

}  // namespace app
