// A simulated hand that is led while a session runs: along one script after another, each from the tick in which it is
// found, and pushed back by the contact force. Where it is held up its script waits, as a hand waits for the bur.
// Without a script it rests. What it did is in the recording, its scripts are not. Frame D, mm, s. exchange(): the
// thread of the ticks; two calls of a script.
#pragma once

#include <atomic>

#include "haptics/device/simulated/hand_script.h"
#include "haptics/device/simulated/virtual_hand.h"
#include "haptics/device/simulated_device.h"

namespace haptics {

/// A script with an end.
struct LedPath {
  HandScript script;
  double duration_s = 0.0;
  double patient_mm = 0.0;  ///< pressed so far beside its path, it goes on no slower
};

class LedHand final : public SimulatedDevice {
 public:
  /// Where it rests to begin with; without pedal.
  explicit LedHand(const HandTarget& rest);
  ~LedHand() override { stop(); }

  /// From the next tick on, from the path's time 0; it must outlive the last tick. One leading thread.
  void lead(const LedPath* path) noexcept { wanted_.store(path, std::memory_order_release); }
  /// The path led last has been gone to its end, or none was led. The leading thread.
  bool hasArrived() const noexcept {
    return arrived_.load(std::memory_order_acquire) == wanted_.load(std::memory_order_relaxed);
  }

  HandleState exchange(const Wrench<calibration::Device>& wrench_D, double dt_s) noexcept override;

 private:
  double pace() const noexcept;

  std::atomic<const LedPath*> wanted_{nullptr}, arrived_{nullptr};
  const LedPath* path_ = nullptr;
  double t_s_ = 0.0;  ///< of the path
  HandTarget target_;
  VirtualHand hand_;
};

}  // namespace haptics
