// Decides when the encoders of a WoodenHaptics are valid. They count from wherever the arm was at power-up. At the home
// position the user presses the calibration switch (or the program calls ask()), the host presets the encoders, and
// once they read back so the arm is home. Only a press that is seen to begin counts, with the motors off. One thread,
// except ask(); no allocation.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "haptics/device/usb/wooden_protocol.h"

namespace haptics {

class WoodenHoming {
 public:
  /// Without a gimbal d, e, f are ignored.
  WoodenHoming(const std::array<std::int16_t, 6>& home_counts, bool has_gimbal)
      : home_counts_(home_counts), encoders_(has_gimbal ? 6 : 3) {}

  /// The arm is at home now. Any thread; ignored while the motors are on.
  void ask() noexcept { asked_.store(true); }

  /// Takes a new reading.
  void take(const WoodenReading& reading, bool motors_on) noexcept;

  bool isHome() const { return phase_ == Phase::home; }
  /// The next report out is to be the preset.
  bool wantsPreset() const { return phase_ == Phase::setting || phase_ == Phase::clearing; }
  const std::array<std::int16_t, 6>& homeCounts() const { return home_counts_; }

 private:
  enum class Phase { away, clearing, setting, home };
  bool readsHome(const WoodenReading& reading) const noexcept;
  /// Pressed for some readings after it was seen released, with the motors off.
  bool pressBegan(bool pressed, bool motors_on) noexcept;

  std::array<std::int16_t, 6> home_counts_;
  std::size_t encoders_;
  std::atomic<bool> asked_{false};
  Phase phase_ = Phase::away;
  bool released_ = false;  ///< seen released since the last press that counted
  int pressed_for_ = 0;    ///< readings in a row
};

}  // namespace haptics
