// Device and servo joined: every tick the handle state becomes a hand sample and Servo::step gives the force. Borrows
// everything; it must outlive the loop and must not be restructured while it runs. Values cross threads by Latest and
// TickLog alone. Simulated time is the sum of the ticks' dt, so a replay needs no clock. Threads: as DeviceLoop.
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
  calibration::Pose<calibration::Patient, calibration::Device> X_PD;  ///< pose of the device
  calibration::Pose<calibration::Handle, calibration::Tool> X_HT;     ///< pose of the tool in the handle
  bool held_by_end = false;  ///< X_HT is that of what works: a file's origin lies its length behind
  std::optional<calibration::MeasuredArm> arm = std::nullopt;  ///< none: the driver's poses
  std::optional<int> priority = kServoPriority;                ///< as DeviceLoop's
  ButtonMeanings buttons;                                      ///< of the handle's buttons
  const FootPedal* pedal = nullptr;                            ///< another drill pedal; borrowed
  TickLog* second_log = nullptr;                               ///< for a second reader; borrowed
};

/// The command with its limits reduced to those of the device at this rate: peak force, torque and joint torques,
/// recommended stiffness and damping, and nine tenths of the stiffest passive wall. With motors also `strict`, its
/// continuous force, and nine tenths of its peak. This one is recorded: a replay has no device.
Command limitedTo(const DeviceCapabilities& device, double rate_Hz, const Command& command);

class HapticLoop final : public DeviceLoop {
 public:
  /// Throws DeviceError when the rate is outside 500..10000 Hz, a pose is not finite and rigid, or the arm not finite.
  HapticLoop(Servo& servo, ServedDevice served, Latest<Command>& commands, TickLog& log, Latest<Tick>& newest,
             const LoopSettings& settings);
  ~HapticLoop() override { stop(); }

  /// Trips of the safety layer so far; one reader.
  const TripCounter& trips() { return trips_.read(); }
  /// Number of presses of the handle's buttons with this action. Any thread.
  std::uint32_t presses(HandAction action) const noexcept {
    return presses_[static_cast<std::size_t>(action)].load(std::memory_order_relaxed);
  }

  /// The actions of the handle's buttons that are held down now. Any thread.
  HandActions held() const noexcept { return {held_.load(std::memory_order_relaxed)}; }

 private:
  Answer answer(const HandleState& state, const TickTiming& timing) noexcept override;
  void answered(double work_us) noexcept override;
  HandSample handFrom(const HandleState& measured, const TickTiming& timing, const Tool& tool) noexcept;
  bool drills(const HandleState& state) noexcept;

  Servo& servo_;
  Latest<Command>& commands_;
  TickLog& log_;
  Latest<Tick>& newest_;
  LoopSettings settings_;
  calibration::Pose<calibration::Device, calibration::Patient> X_DP_;

  // Device thread: the arm, the newest tick, and the velocity of the tool relative to the handle.
  MeasuredHandle handle_;
  Tick tick_;
  glm::dvec3 last_arm_P_mm_{0.0}, arm_velocity_P_mm_per_s_{0.0};
  bool has_arm_ = false;
  double reach_mm_ = 0.0;  ///< of the tool
  PressCount press_count_;
  TripCounter ledger_;
  Fault last_faults_ = Fault::none;

  Latest<TripCounter> trips_;
  std::array<std::atomic<std::uint32_t>, kHandActions> presses_{};
  std::atomic<std::uint8_t> held_{0};
};

}  // namespace haptics
