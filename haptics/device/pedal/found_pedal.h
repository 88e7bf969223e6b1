// Which input devices are pedals. Automatically only a foot switch, by name or identity, a joystick or a gamepad; a
// keyboard, mouse or touch pad only when its owner names it, and then it is read but never grabbed. Reads /sys, opens
// nothing. Any thread. Identities of foot switches: rgerganov/footswitch (PCsensor and its kin), the USB ID list (VEC
// Infinity).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "haptics/device/pedal/input_traits.h"

namespace haptics {

enum class InputKind { foot_switch, joystick, keyboard, other };

InputKind kindOf(const InputTraits& traits);

/// Folders of the input devices.
struct InputFolders {
  std::filesystem::path classes = "/sys/class/input", nodes = "/dev/input";
};

struct FoundPedal {
  InputTraits traits;
  InputKind kind = InputKind::other;
  std::filesystem::path path;
  bool may_be_read = false;

  /// Sends letters like a keyboard, so it is grabbed. Only a foot switch ever is.
  bool sendsLetters() const { return kind == InputKind::foot_switch && traits.letters() > 0; }
};

/// Foot switches first, then joysticks.
std::vector<FoundPedal> findPedals(const InputFolders& folders = {});

/// Candidates for `wanted`, best first: "auto" as findPedals, else a path or a part of a name in either case, of any
/// kind of device.
std::vector<FoundPedal> pedalsMeant(const std::string& wanted, const InputFolders& folders = {});

}  // namespace haptics
