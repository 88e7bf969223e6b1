// Every Phantom and Touch through 3D Systems' library. The vendor's scheduler calls, and each call is one tick: a frame
// in which the handle is read, the servo is called, the force is set in N along HDAPI's axes (frame D), and errors are
// drained. No allocation, lock or throw of ours; the library's own cost is not bounded by us. The vendor's guards
// (force clamping, ramping, limits of force, impulse and velocity) stay on. A fatal error switches the motors off for
// good and shows as an unhealthy device; the ticks go on. While the vendor's scheduler hangs, no other thread may call
// the library (reference/devices 2), so motorsOff() waits for its next call and the last force stands until the
// device's own watchdog, if it has one: that is not documented. Never run on a real unit.
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
  std::string configuration{};         ///< name in the vendor's set-up; empty: the default device
  std::optional<bool> docked_value{};  ///< of the inkwell's switch with a docked stylus; none: learned
  std::uint32_t pedal_buttons = 0b01;  ///< these buttons of the stylus act as the pedal
};

class OpenHaptics final : public HapticDevice {
 public:
  /// Throws DeviceError when the device does not start.
  explicit OpenHaptics(const HdLibrary& library, const OpenHapticsSettings& settings = {});
  ~OpenHaptics() override;
  OpenHaptics(const OpenHaptics&) = delete;
  OpenHaptics& operator=(const OpenHaptics&) = delete;

  const DeviceCapabilities& capabilities() const override { return description_.capabilities; }
  /// Also throws DeviceError while another OpenHaptics device runs: there is one scheduler.
  void start(DeviceServo& servo, double rate_Hz) override;
  void stop() noexcept override;
  void motorsOff() noexcept override { off_requests_.fetch_add(1); }

  std::string trouble() const override;
  /// Errors of the library so far, passing ones included. Any thread.
  const HdErrors& errors() const { return errors_; }
  /// Of the inkwell's switch with a docked stylus, once known. Any thread.
  std::optional<bool> dockedValue() const { return handle_.inkwell().dockedValue(); }
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

  // Of the thread of start() and stop().
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
