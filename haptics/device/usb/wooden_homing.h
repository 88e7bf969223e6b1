// When a WoodenHaptics' encoders may be believed. They count from wherever the arm was when the power came; at the home
// position the owner presses the calibration switch (or says so to the program), the host presets the encoders, and
// once they read so the arm is home. Only a press that is seen to begin counts, and only with the motors off. One
// thread but for ask(); no allocation.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "haptics/device/usb/wooden_protocol.h"

namespace haptics {

class WoodenHoming {
 public:
  /// Without a gimbal d, e, f are not looked at.
  WoodenHoming(const std::array<std::int16_t, 6>& home_counts, bool has_gimbal)
      : home_counts_(home_counts), encoders_(has_gimbal ? 6 : 3) {}

  /// The arm stands at home now. Any thread; forgotten when the motors are on.
  void ask() noexcept { asked_.store(true); }

  /// A new reading came.
  void take(const WoodenReading& reading, bool motors_on) noexcept;

  bool isHome() const { return phase_ == Phase::home; }
  /// The next report out is to be the preset.
  bool wantsPreset() const { return phase_ == Phase::setting || phase_ == Phase::clearing; }
  const std::array<std::int16_t, 6>& homeCounts() const { return home_counts_; }

 private:
  enum class Phase { away, clearing, setting, home };
  bool readsHome(const WoodenReading& reading) const noexcept;
  /// Pressed steadily, having been seen released before, with the motors off.
  bool pressBegan(bool pressed, bool motors_on) noexcept;

  std::array<std::int16_t, 6> home_counts_;
  std::size_t encoders_;
  std::atomic<bool> asked_{false};
  Phase phase_ = Phase::away;
  bool released_ = false;  ///< seen so since it last counted for anything
  int pressed_for_ = 0;    ///< readings in a row
};

}  // namespace haptics
