#include "app/procedure/third_molar/led_keys.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace app {

haptics::HandTarget targetAt(const HandPose& X_PT, bool pedal) {
  return {X_PT.translation_mm, X_PT.rotation, pedal, 0, true};
}

void LedKeys::moveTo(const HandPose& X_PT, double mm_per_s, double rad_per_s) {
  const Key& last = keys_.back();
  const double turn_rad = 2.0 * std::acos(std::min(1.0, std::abs(glm::dot(last.X_PT.rotation, X_PT.rotation))));
  const double takes_s =
      std::max({glm::distance(last.X_PT.translation_mm, X_PT.translation_mm) / mm_per_s, turn_rad / rad_per_s, 0.01});
  keys_.push_back({last.t_s + takes_s, X_PT, last.pedal});
}

void LedKeys::hold(double seconds) {
  keys_.push_back({keys_.back().t_s + seconds, keys_.back().X_PT, keys_.back().pedal});
}

haptics::LedPath LedKeys::path() {
  const double end_s = keys_.back().t_s;
  return {[keys = std::move(keys_)](double t_s) {
            const auto next = std::ranges::upper_bound(keys, t_s, {}, &Key::t_s);
            if (next == keys.begin()) return targetAt(next->X_PT, next->pedal);
            if (next == keys.end()) return targetAt(keys.back().X_PT, keys.back().pedal);
            const Key& from = *(next - 1);
            const double part = (t_s - from.t_s) / (next->t_s - from.t_s);
            return targetAt({glm::slerp(from.X_PT.rotation, next->X_PT.rotation, part),
                             glm::mix(from.X_PT.translation_mm, next->X_PT.translation_mm, part)},
                            from.pedal);
          },
          end_s};
}

}  // namespace app
