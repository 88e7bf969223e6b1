// A foot pedal or joystick, read through libevdev by a thread of its own: which actions are held and how often each
// began, as atomics for any thread. Unplugged, nothing is held; it is searched for every half second. A foot switch
// that types letters is grabbed, so that it types into no window; no other device is. Selection: found_pedal.
// Construction opens nothing and throws for a bad mapping only.
#pragma once

#include <array>
#include <atomic>
#include <mutex>
#include <string>
#include <thread>

#include "haptics/device/pedal/hand_action.h"
#include "haptics/device/pedal/pedal_mapping.h"

namespace haptics {

struct PedalChoice {
  std::string wanted = "auto";  ///< or a path, or a part of its name
  PedalMapping mapping;
};

class FootPedal {
 public:
  /// Throws DeviceError when the mapping names no switch.
  explicit FootPedal(const PedalChoice& choice, InputFolders folders = {});
  ~FootPedal();
  FootPedal(const FootPedal&) = delete;
  FootPedal& operator=(const FootPedal&) = delete;

  bool isThere() const noexcept { return there_.load(std::memory_order_relaxed); }
  HandActions held() const noexcept { return {held_.load(std::memory_order_relaxed)}; }
  std::uint32_t presses(HandAction action) const noexcept {
    return presses_[static_cast<std::size_t>(action)].load(std::memory_order_relaxed);
  }
  /// "PCsensor FootSwitch, /dev/input/event7", or why there is none. Locks.
  std::string described() const;

 private:
  class Reading;

  void run();
  void publish(HandActions held);
  void describe(std::string text);

  PedalChoice choice_;
  InputFolders folders_;
  std::vector<PedalSwitch> chosen_;
  PressCount count_;  // the thread's
  std::atomic<std::uint8_t> held_{0};
  std::array<std::atomic<std::uint32_t>, kHandActions> presses_{};
  std::atomic<bool> there_{false};
  mutable std::mutex mutex_;
  std::string described_;
  int wake_fd_ = -1;
  std::thread thread_;
};

}  // namespace haptics
