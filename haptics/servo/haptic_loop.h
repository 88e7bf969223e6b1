// The haptic loop: device and servo joined. Every tick the handle becomes the hand's sample and Servo::step answers.
// Owns nothing it serves; everything it borrows must outlive it and must not be restructured while it runs. Values
// cross by Latest and TickLog alone. Simulated time is the sum of the ticks' dt whatever the clock does, so a replay
// needs no clock. Threads: as DeviceLoop.
#pragma once

#include <array>
#include <atomic>
#include <optional>

#include "haptics/device/pedal/foot_pedal.h"
#include "haptics/device/thread_priority.h"
#include "haptics/latest.h"
#include "haptics/loop/device_loop.h"
#include "haptics/safety/trips.h"
#include "haptics/servo/measured_handle.h"
#include "haptics/servo/servo.h"
#include "haptics/servo/tick_log.h"

namespace haptics {

struct LoopSettings {
  double rate_Hz = 1000.0;                                            ///< 500..10000
  calibration::Pose<calibration::Patient, calibration::Device> X_PD;  ///< where the device stands
  calibration::Pose<calibration::Handle, calibration::Tool> X_HT;     ///< how the handle holds the tool
  std::optional<calibration::MeasuredArm> arm = std::nullopt;         ///< none: as the device's driver has it
  std::optional<int> priority = kServoPriority;                       ///< as DeviceLoop's
  ButtonMeanings buttons;                                             ///< of those on the handle
  const FootPedal* pedal = nullptr;                                   ///< drills beside them; borrowed
  TickLog* second_log = nullptr;                                      ///< another reader's of every tick; borrowed
};

/// The command with its limits cut down to what the device can give and hold at this rate: peak force, torque and joint
/// torques, the stiffness and damping that its maker or users recommend, and slopes no steeper than nine tenths of the
/// stiffest wall. For a device with motors also `strict`, its continuous force, and nine tenths of its peak. Record
/// this one: a replay has no device.
Command limitedTo(const DeviceCapabilities& device, double rate_Hz, const Command& command);

class HapticLoop final : public DeviceLoop {
 public:
  /// Throws DeviceError when the rate is outside 500..10000 Hz, a pose is not finite and rigid, or the arm not finite.
  HapticLoop(Servo& servo, ServedDevice served, Latest<Command>& commands, TickLog& log, Latest<Tick>& newest,
             const LoopSettings& settings);
  ~HapticLoop() override { stop(); }

  /// What the safety layer did so far; one reader.
  const TripCounter& trips() { return trips_.read(); }
  /// How often a button of the handle asked for it. Any thread.
  std::uint32_t presses(HandAction action) const noexcept {
    return presses_[static_cast<std::size_t>(action)].load(std::memory_order_relaxed);
  }

 private:
  Answer answer(const HandleState& state, const TickTiming& timing) noexcept override;
  void answered(double work_us) noexcept override;
  HandSample handFrom(const HandleState& measured, const TickTiming& timing) noexcept;
  bool drills(const HandleState& state) noexcept;

  Servo& servo_;
  Latest<Command>& commands_;
  TickLog& log_;
  Latest<Tick>& newest_;
  LoopSettings settings_;
  calibration::Pose<calibration::Device, calibration::Patient> X_DP_;

  // Of the device's thread: the arm, the newest tick, and what turning adds to the tool's velocity.
  MeasuredHandle handle_;
  Tick tick_;
  glm::dvec3 last_arm_P_mm_{0.0}, arm_velocity_P_mm_per_s_{0.0};
  bool has_arm_ = false;
  PressCount press_count_;
  TripCounter ledger_;
  Fault last_faults_ = Fault::none;

  Latest<TripCounter> trips_;
  std::array<std::atomic<std::uint32_t>, kHandActions> presses_{};
};

}  // namespace haptics
