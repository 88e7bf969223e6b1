#include "haptics/device/usb/wooden_homing.h"

#include <cstdlib>

namespace haptics {
namespace {

/// How far a hand holding still may move an encoder after the preset.
constexpr int kNear_counts = 100;
/// A press stays latched until the host presets; a corrupt report does not repeat so often.
constexpr int kSteady_readings = 5;

}  // namespace

bool WoodenHoming::readsHome(const WoodenReading& reading) const noexcept {
  if (reading.switch_pressed) return false;
  for (std::size_t i = 0; i < encoders_; ++i)
    if (std::abs(reading.encoders[i] - home_counts_[i]) > kNear_counts) return false;
  return true;
}

bool WoodenHoming::pressBegan(bool pressed, bool motors_on) noexcept {
  if (!pressed) {
    released_ = true;
    pressed_for_ = 0;
    return false;
  }
  // A press with the motors on does not say where the arm is later.
  if (motors_on) released_ = false;
  if (!released_ || ++pressed_for_ < kSteady_readings) return false;
  released_ = false;
  return true;
}

void WoodenHoming::take(const WoodenReading& reading, bool motors_on) noexcept {
  const bool pressed = pressBegan(reading.switch_pressed, motors_on);
  const bool asked = asked_.exchange(false);
  if (!motors_on && (asked || pressed)) {
    phase_ = Phase::setting;
    return;
  }
  switch (phase_) {
    case Phase::away:
      // Pressed before the start, at an unknown position. A preset clears it.
      if (reading.switch_pressed && !released_) phase_ = Phase::clearing;
      break;
    case Phase::clearing:
      if (!reading.switch_pressed) phase_ = Phase::away;
      break;
    case Phase::setting:
      if (readsHome(reading)) phase_ = Phase::home;
      break;
    case Phase::home:
      break;
  }
}

}  // namespace haptics
