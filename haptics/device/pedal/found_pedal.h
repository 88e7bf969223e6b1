// Which input devices are pedals. One is taken by itself only when it says so: a foot switch by name or identity, or a
// joystick or gamepad. A keyboard, a mouse, a touch pad is never taken by itself; named by its owner it is read beside
// whoever else reads it, and never grabbed. Looks at /sys, opens nothing. Any thread; reads some files.
// Identities of foot switches: rgerganov/footswitch (PCsensor and its kin), the USB ID list (VEC Infinity).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "haptics/device/pedal/input_traits.h"

namespace haptics {

enum class InputKind { foot_switch, joystick, keyboard, other };

InputKind kindOf(const InputTraits& traits);

/// Where input devices are.
struct InputFolders {
  std::filesystem::path classes = "/sys/class/input", nodes = "/dev/input";
};

struct FoundPedal {
  InputTraits traits;
  InputKind kind = InputKind::other;
  std::filesystem::path path;
  bool may_be_read = false;

  /// It sends letters as a keyboard would, which nobody else should see. Only a foot switch is ever kept to ourselves.
  bool sendsLetters() const { return kind == InputKind::foot_switch && traits.letters() > 0; }
};

/// Foot switches first, then joysticks.
std::vector<FoundPedal> findPedals(const InputFolders& folders = {});

/// Those that `wanted` may mean, best first: "auto" what findPedals finds, else a path or a part of a name in either
/// case, and then any kind of device.
std::vector<FoundPedal> pedalsMeant(const std::string& wanted, const InputFolders& folders = {});

}  // namespace haptics
