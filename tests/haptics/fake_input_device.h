// An input device without a kernel: its traits laid out as in /sys/class/input, its events through a pipe, and an
// ioctl() of this program that answers libevdev's requests for that pipe. For tests.
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

/// A temporary folder with `classes` and `nodes`.
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
  /// Raw bytes: half an event, or garbage.
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
