// Whether the hand may be pushed at all (reference/devices 6.2): off, calibrate, ready, armed, active, fault. There is
// force in `active` alone. Ready becomes armed only outside tissue, at rest and out of the inkwell, and active when a
// hand is felt; docking and a pause go back to ready; a fault stays until the instructor lifts it; after a stop it
// is off for good. Where nobody can be pushed (`must_be_armed` false) it is active at once and nothing is latched.
// State: a few numbers; servo thread, no clock.
#pragma once

#include <cstdint>

#include "haptics/safety/safety_limits.h"

namespace haptics {

enum class SafetyState : std::uint8_t { off, calibrate, ready, armed, active, fault };

/// Whether the motors may be on, with force or without.
constexpr bool mayRunMotors(SafetyState state) { return state != SafetyState::off && state != SafetyState::fault; }

class SafetyStateMachine {
 public:
  /// What it goes by, this tick.
  struct Inputs {
    bool stop_requested = false, trouble = false, calibrated = true, docked = false, held = true, resumed = false;
    bool touches = true;        ///< the tool is in tissue, as far as is known
    double speed_mm_per_s = 0;  ///< of the hand
    std::uint64_t rearm = 0;    ///< a number that is not the last one lifts a fault whose cause is over
  };
  SafetyState follow(const Inputs& seen, const SafetyLimits& limits, double dt_s) noexcept;

  SafetyState state() const { return state_; }
  /// Active, but the deadman feels no hand.
  bool isReleasing() const { return state_ == SafetyState::active && let_go_s_ > 0.0; }

 private:
  SafetyState next(const Inputs& seen, const SafetyLimits& limits, double dt_s) noexcept;

  SafetyState state_ = SafetyState::off;
  double let_go_s_ = 0.0;
  std::uint64_t last_rearm_ = 0;
  bool stopped_ = false;
};

}  // namespace haptics
