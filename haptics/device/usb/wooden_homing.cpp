#include "haptics/device/usb/wooden_homing.h"

#include <cstdlib>

namespace haptics {
namespace {

/// How far a hand that holds still may have moved an encoder since it was preset.
constexpr int kNear_counts = 100;

}  // namespace

bool WoodenHoming::readsHome(const WoodenReading& reading) const noexcept {
  if (reading.switch_pressed) return false;
  for (std::size_t i = 0; i < encoders_; ++i)
    if (std::abs(reading.encoders[i] - home_counts_[i]) > kNear_counts) return false;
  return true;
}

void WoodenHoming::take(const WoodenReading& reading, bool motors_on) noexcept {
  const bool pressed_now = reading.switch_pressed && seen_released_;
  seen_released_ = !reading.switch_pressed;
  // Asked or pressed in mid-stroke it says nothing of where the arm is when the motors go off.
  const bool asked = asked_.exchange(false);
  if (!motors_on && (asked || pressed_now)) {
    phase_ = Phase::setting;
    return;
  }
  switch (phase_) {
    case Phase::away:
      // Pressed before anybody looked: at what place is not known. A preset forgets it.
      if (reading.switch_pressed) phase_ = Phase::clearing;
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
