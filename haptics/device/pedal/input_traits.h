// What the kernel tells of an input device to everybody: name, identity, which keys and axes it has, from
// /sys/class/input. The device itself is not opened, so a keyboard is looked at without being listened to. Reading
// files; any thread. Layout: the kernel's Documentation/ABI and include/linux/mod_devicetable (EV, KEY, ABS, REL bits).
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

/// Numbers of set bits in the kernel's text for a bit map: words of 64 in hexadecimal, highest first.
std::vector<std::uint16_t> bitsInText(const std::string& text);

/// Every device that reports events, by number of its node; none where the folder is missing. What can not be read
/// stays empty.
std::vector<InputTraits> inputDevices(const std::filesystem::path& class_folder);

}  // namespace haptics
