#include "haptics/contact/agus.h"

#include "haptics/contact/immersion.h"

namespace haptics {

Contact agusContact(const AgusParameters& parameters, const ToolInBone& at) noexcept {
  const Immersion immersion = immersionOf(at);
  return contactAlongNormal(immersion, parameters.stiffness_N_per_mm * immersion.depth_mm,
                            parameters.stiffness_N_per_mm);
}

}  // namespace haptics
