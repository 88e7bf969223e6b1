// Which switch of a pedal triggers which action, by the kernel's names (KEY_B, BTN_TRIGGER, ABS_GAS; see `evtest`), and
// the defaults: a foot switch that types letters drills with any of them; other switches and the axes of a foot switch
// are drill, irrigation, undo, tool change in order; of a joystick the first four buttons, accelerator and brake.
// Start-up only.
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

/// Empty: the defaults for the pedal.
using PedalMapping = std::vector<PedalBinding>;

/// Throws DeviceError for an unknown name or a threshold outside its range.
PedalSwitch switchOf(const PedalBinding& binding);

/// Without the ranges of axes.
std::vector<PedalSwitch> usualSwitches(const FoundPedal& pedal);

}  // namespace haptics
