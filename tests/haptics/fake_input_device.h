// An input device without a kernel behind it: its traits laid out as in /sys/class/input, its events through a pipe,
// and an ioctl() of this program's own that answers what libevdev asks of such a pipe. For tests.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "haptics/device/pedal/found_pedal.h"

namespace haptics {

struct FakeTraits {
  std::string name;
  std::vector<std::uint16_t> keys = {}, axes = {}, relative = {};
  std::uint16_t vendor = 0x1111, product = 0x2222;
  int least = 0, most = 255;  ///< of every axis
  std::vector<std::uint16_t> down = {};
};

/// A folder of its own with `classes` and `nodes`, removed in the end.
class FakeInputFolder {
 public:
  explicit FakeInputFolder(const std::string& name);
  ~FakeInputFolder();
  FakeInputFolder(const FakeInputFolder&) = delete;
  FakeInputFolder& operator=(const FakeInputFolder&) = delete;

  const InputFolders& folders() const { return folders_; }

 private:
  std::filesystem::path root_;
  InputFolders folders_;
};

/// Plugged in from construction to unplug() or destruction.
class FakeInputDevice {
 public:
  FakeInputDevice(const FakeInputFolder& folder, int number, const FakeTraits& traits);
  ~FakeInputDevice();
  FakeInputDevice(const FakeInputDevice&) = delete;
  FakeInputDevice& operator=(const FakeInputDevice&) = delete;

  void send(std::uint16_t type, std::uint16_t code, std::int32_t value);
  /// Half an event, or anything else.
  void sendBytes(const std::string& bytes);
  void unplug();
  bool isGrabbed() const;
  bool wasOpened() const;
  std::string path() const { return node_.string(); }

 private:
  std::filesystem::path class_, node_;
  int fd_ = -1;
  std::uint64_t inode_ = 0;
};

}  // namespace haptics
