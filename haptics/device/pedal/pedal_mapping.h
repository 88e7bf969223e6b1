// Which switch of a pedal means what, by the kernel's names (KEY_B, BTN_TRIGGER, ABS_GAS; `evtest` shows them), and
// what is usual where nobody said: a foot switch that types letters drills with any of them; other switches and the
// axes of a foot switch mean drill, irrigation, undo, tool change in order; of a joystick the first four buttons,
// accelerator and brake. Start-up only.
#pragma once

#include <string>
#include <vector>

#include "haptics/device/pedal/found_pedal.h"
#include "haptics/device/pedal/pedal_switches.h"

namespace haptics {

struct PedalBinding {
  std::string control;  ///< "+ABS_Z" rests at its low end, "-ABS_Z" at its high end
  HandAction action = HandAction::drill;
  double threshold = 0.5;  ///< axes: of the travel, 0.15 to 0.95
};

/// Empty: what is usual for the pedal that is found.
using PedalMapping = std::vector<PedalBinding>;

/// Throws DeviceError for a name the kernel does not have or a threshold outside its range.
PedalSwitch switchOf(const PedalBinding& binding);

/// Ranges of axes are not known here.
std::vector<PedalSwitch> usualSwitches(const FoundPedal& pedal);

}  // namespace haptics
