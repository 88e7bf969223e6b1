#include "haptics/device/pedal/pedal_mapping.h"

#include <libevdev/libevdev.h>

#include <algorithm>

#include "haptics/device/haptic_device.h"

namespace haptics {
namespace {

constexpr double kLeastThreshold = 0.15, kMostThreshold = 0.95;

bool isPedalOfAJoystick(std::uint16_t axis) { return axis == ABS_GAS || axis == ABS_BRAKE; }

}  // namespace

PedalSwitch switchOf(const PedalBinding& binding) {
  PedalSwitch one{.action = binding.action, .threshold = binding.threshold};
  std::string name = binding.control;
  if (!name.empty() && (name[0] == '+' || name[0] == '-')) {
    one.rest = name[0] == '+' ? AxisRest::low : AxisRest::high;
    name.erase(0, 1);
  }
  one.is_axis = name.starts_with("ABS_");
  const int code = libevdev_event_code_from_name(one.is_axis ? EV_ABS : EV_KEY, name.c_str());
  if (code < 0 || (one.rest != AxisRest::unknown && !one.is_axis))
    throw DeviceError("pedal: " + binding.control.substr(0, 40) +
                      " is no switch or axis, give a name as evtest shows it: KEY_B, BTN_TRIGGER, ABS_GAS");
  if (!(binding.threshold >= kLeastThreshold && binding.threshold <= kMostThreshold))
    throw DeviceError("pedal: the threshold of " + name + " must lie between 0.15 and 0.95 of its travel");
  one.code = static_cast<std::uint16_t>(code);
  return one;
}

std::vector<PedalSwitch> usualSwitches(const FoundPedal& pedal) {
  std::vector<PedalSwitch> switches;
  const auto add = [&](bool is_axis, std::uint16_t code) {
    if (switches.size() < kHandActions)
      switches.push_back({.is_axis = is_axis, .code = code, .action = static_cast<HandAction>(switches.size())});
  };
  if (pedal.traits.letters() > 0) {
    for (const std::uint16_t key : pedal.traits.keys) switches.push_back({.code = key});
    return switches;
  }
  for (const std::uint16_t key : pedal.traits.keys) add(false, key);
  if (pedal.kind == InputKind::foot_switch)
    for (const std::uint16_t axis : pedal.traits.axes) add(true, axis);
  if (pedal.kind == InputKind::joystick)
    for (const std::uint16_t axis : pedal.traits.axes)
      if (isPedalOfAJoystick(axis))
        switches.push_back(
            {.is_axis = true, .code = axis, .action = axis == ABS_GAS ? HandAction::drill : HandAction::irrigation});
  return switches;
}

}  // namespace haptics
