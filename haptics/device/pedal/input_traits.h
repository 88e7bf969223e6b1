// What sysfs shows of an input device to every user: name, identity, keys and axes, from /sys/class/input. The device
// is not opened, so a keyboard is not read. Reads files; any thread. Layout: the kernel's Documentation/ABI and
// include/linux/mod_devicetable (EV, KEY, ABS, REL bits).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace haptics {

struct InputTraits {
  std::string name, node;  ///< node: "event4"
  std::uint16_t vendor = 0, product = 0;
  std::vector<std::uint16_t> keys, axes;  ///< codes, ascending: KEY_* and BTN_*, ABS_*
  bool moves_a_pointer = false;           ///< REL_X

  bool hasKey(std::uint16_t code) const;
  /// Of the letters A to Z.
  int letters() const;
};

/// Indices of the set bits in the kernel's text of a bit map: 64-bit hexadecimal words, highest first.
std::vector<std::uint16_t> bitsInText(const std::string& text);

/// Every device with an event node, by its number; none if the folder is missing. Unreadable fields stay empty.
std::vector<InputTraits> inputDevices(const std::filesystem::path& class_folder);

}  // namespace haptics
