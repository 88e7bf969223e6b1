#include "haptics/contact/hertz.h"

#include <cmath>

#include "haptics/contact/immersion.h"

namespace haptics {

Contact hertzContact(const HertzParameters& parameters, const ToolInBone& at) noexcept {
  const Immersion immersion = immersionOf(at);
  const double root_mm = std::sqrt(at.head.radius_mm * immersion.depth_mm);
  return contactAlongNormal(immersion, parameters.hertz_N_per_mm2 * root_mm * immersion.depth_mm,
                            1.5 * parameters.hertz_N_per_mm2 * root_mm);
}

}  // namespace haptics
