// Every Phantom and Touch that 3D Systems' library drives. The vendor's scheduler calls, and each call is one tick: a
// frame in which the handle is read, the servo answers, the force is set in N along HDAPI's axes (frame D), and the
// errors are drained. Bounded, no allocation, lock or throw of ours; the library's own cost is its own. The vendor's
// guards (force clamping, ramping, limits of force, impulse and velocity) stay on. Trouble that is fatal takes the
// motors off for good and shows as an unhealthy device; the ticks go on. While the vendor's scheduler itself hangs, no
// other thread may speak to the device (reference/devices 2), so motorsOff() waits for its next call and the last force
// stands until the device's own watchdog, if it has one: that is not documented. Never run on a real unit.
#pragma once

#include <array>
#include <atomic>
#include <optional>
#include <string>

#include "haptics/device/openhaptics/callback_timing.h"
#include "haptics/device/openhaptics/hd_calibration.h"
#include "haptics/device/openhaptics/hd_handle.h"
#include "haptics/device/openhaptics/hd_session.h"
#include "haptics/latest.h"

namespace haptics {

struct OpenHapticsSettings {
  std::string configuration{};         ///< the name the vendor's set-up gave the device; empty: the default device
  std::optional<bool> docked_value{};  ///< what the inkwell's switch shows of a docked stylus; none: learned
  std::uint32_t pedal_buttons = 0b01;  ///< these buttons of the stylus stand for a pedal
};

class OpenHaptics final : public HapticDevice {
 public:
  /// Throws DeviceError when the device does not start.
  explicit OpenHaptics(const HdLibrary& library, const OpenHapticsSettings& settings = {});
  ~OpenHaptics() override;
  OpenHaptics(const OpenHaptics&) = delete;
  OpenHaptics& operator=(const OpenHaptics&) = delete;

  const DeviceCapabilities& capabilities() const override { return description_.capabilities; }
  /// Throws DeviceError too when another device of OpenHaptics runs: the vendor's scheduler is one.
  void start(DeviceServo& servo, double rate_Hz) override;
  void stop() noexcept override;
  void motorsOff() noexcept override { off_requests_.fetch_add(1); }

  /// What is wrong, or what a person has to do now, in one sentence; empty: all is well. Any thread.
  std::string trouble() const override;
  /// Errors of the library so far, those that passed by themselves too. Any thread.
  const HdErrors& errors() const { return errors_; }
  /// What the inkwell's switch shows of a docked stylus, once that is known. Any thread.
  std::optional<bool> dockedValue() const { return handle_.inkwell().dockedValue(); }
  /// The arm is in its reset position now, for a device that is calibrated that way. Any thread.
  void setHome() noexcept override { calibration_.resetHere(); }

 private:
  enum class Phase { idle, serving, leaving, over };

  unsigned serve() noexcept;
  HandleState sense() noexcept;
  void drive(const MotorCommand& command) noexcept;
  void letGo() noexcept;
  void awaitLastFrame() noexcept;
  void absorbErrors() noexcept;
  bool isDead() const { return errors_.firstFatal().code != hd::kSuccess; }
  void switchGuardsOn();

  const HdFunctions hd_;
  HdSession session_;
  HdDescription description_;
  HdErrors errors_;
  HdCalibration calibration_;
  HdHandle handle_;

  // Of the thread that starts and stops.
  bool started_ = false, has_scheduler_ = false, scheduler_runs_ = false;
  std::optional<hd::ScheduleId> schedule_;

  // Of the scheduler's thread.
  DeviceServo* servo_ = nullptr;
  double rate_Hz_ = 1000.0;
  CallbackTiming timing_{1000.0};
  bool begun_ = false, motors_on_ = false;
  std::uint32_t off_requests_applied_ = 0;
  int warm_ticks_left_ = 0;

  std::atomic<Phase> phase_{Phase::idle};
  std::atomic<std::uint32_t> off_requests_{0};
};

}  // namespace haptics
