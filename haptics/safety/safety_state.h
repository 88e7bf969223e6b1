// State of the force output (reference/devices 6.2): off, calibrate, ready, armed, active, fault. Force in
// `active` alone. Ready becomes armed outside tissue, at rest and out of the inkwell, and active when a hand is
// detected; docking and a pause lead back to ready; a fault stays until the instructor clears it; a stop is final. For
// a device without motors (`must_be_armed` false) it is active at once and nothing latches. Servo thread, no clock.
#pragma once

#include <cstdint>

#include "haptics/safety/safety_limits.h"

namespace haptics {

enum class SafetyState : std::uint8_t { off, calibrate, ready, armed, active, fault };

/// Whether the motors may be on, with force or without.
constexpr bool mayRunMotors(SafetyState state) { return state != SafetyState::off && state != SafetyState::fault; }

class SafetyStateMachine {
 public:
  struct Inputs {
    bool stop_requested = false, trouble = false, calibrated = true, docked = false, held = true, resumed = false;
    bool touches = true;        ///< the tool is in tissue, or it is not known
    double speed_mm_per_s = 0;  ///< of the hand
    std::uint64_t rearm = 0;    ///< a change clears a fault whose cause is over
  };
  SafetyState update(const Inputs& inputs, const SafetyLimits& limits, double dt_s) noexcept;

  SafetyState state() const { return state_; }
  /// Active, but the deadman detects no hand.
  bool isReleasing() const { return state_ == SafetyState::active && let_go_s_ > 0.0; }

 private:
  SafetyState next(const Inputs& inputs, const SafetyLimits& limits, double dt_s) noexcept;

  SafetyState state_ = SafetyState::off;
  double let_go_s_ = 0.0;
  std::uint64_t last_rearm_ = 0;
  bool stopped_ = false;
};

}  // namespace haptics
