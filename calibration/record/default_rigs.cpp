#include "calibration/record/default_rigs.h"

namespace calibration {

std::optional<Rig> defaultRig(std::string_view name) {
  if (name == kDefaultRigs[0]) return mirroredWorkstationRig();
  if (name == kDefaultRigs[1]) return desktopRig({1920, 1080});
  return std::nullopt;
}

}  // namespace calibration
