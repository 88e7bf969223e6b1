// A WoodenHaptics (mbed HID firmware, 1234:0006) over libusb: three degrees of force, position, orientation where it
// has a gimbal. Opened, woken, homed by its owner's hand; then a report each way a tick, the tick as soon as a report
// came. Motors off is 0 mA for every motor: the firmware has no other switch, but disables its amplifiers 0.5 s after
// the last report; this side rests them after 20 ms of silence, from the USB's own thread. No force while it is not
// homed or the line is not well. Frame D as wooden_kinematics. Threads as HapticDevice. Its newtons follow from the
// published torque constants and capstans; no scale has weighed them. Never run on a real unit. Facts:
// reference/devices 3.1.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "haptics/device/found_device.h"
#include "haptics/device/paced_device.h"
#include "haptics/device/thread_priority.h"
#include "haptics/device/usb/usb_clock.h"
#include "haptics/device/usb/wooden_homing.h"
#include "haptics/device/usb/wooden_kinematics.h"
#include "haptics/device/usb/wooden_model.h"

namespace haptics {

class UsbTransport;
struct UsbCounters;

inline constexpr const char* kWoodenHomingPrompt =
    "hold the arm at its home position, turret straight ahead, upper arm upright, forearm level, and press the "
    "calibration switch";

enum class HomingAnswer { wait, stands_at_home, give_up };
/// What its owner shall do now, again and again until it is done.
using WoodenPrompt = std::function<HomingAnswer(const std::string& words)>;

struct WoodenSettings {
  std::string path;  ///< bus and ports, "1-2.3"; empty: the first
  /// Of the published builds the one that a wrong guess makes weaker, not stronger.
  WoodenModel model = woodenHaptics2019();
  WoodenPrompt tell;
  std::chrono::seconds homing_patience{60};  ///< 0: does not wait, ticks uncalibrated until it is homed
  int servo_priority = kServoPriority;       ///< the thread that reads its USB lies next to it
  UsbClock clock = {};
};

/// "wooden", "wooden:1-2", "wooden:v2015", "wooden:1-2,v2015"; none when it is no such address.
std::optional<WoodenSettings> woodenAddressed(std::string_view address);

class WoodenHaptics final : public PacedDevice {
 public:
  /// Opens, wakes, homes. Throws DeviceError with the next step when one of them fails.
  explicit WoodenHaptics(const WoodenSettings& settings);
  ~WoodenHaptics() override;

  const DeviceCapabilities& capabilities() const override { return capabilities_; }
  void start(DeviceServo& servo, double rate_Hz) override;
  void stop() noexcept override;
  void motorsOff() noexcept override;

  /// It stands at its home position now. Any thread; forgotten when the motors are on.
  void setHome() noexcept override { homing_.ask(); }

  /// Any thread.
  UsbCounters counters() const noexcept;

 private:
  HandleState sense(double dt_s) noexcept override;
  void drive(const MotorCommand& command) noexcept override;
  void await(std::int64_t deadline_ns) noexcept override;

  void wake();
  void awaitHoming(const WoodenSettings& settings);
  bool listen() noexcept;
  void move(const WoodenReading& reading, std::int64_t received_ns) noexcept;
  std::string where() const;

  WoodenModel model_;
  WoodenKinematics kinematics_;
  WoodenHoming homing_;
  std::unique_ptr<UsbTransport> usb_;
  DeviceCapabilities capabilities_;
  std::int64_t period_ns_ = 0;

  // Of the device's thread.
  HandleState state_;
  WoodenJoints joints_;
  std::uint64_t serial_ = 0;
  std::int64_t received_ns_ = 0;
  std::uint32_t rests_ = 0;
  bool motors_on_ = false, has_place_ = false;
};

/// Without opening anything. Throws DeviceError when USB can not be looked at.
std::vector<FoundDevice> findWoodenHaptics();

}  // namespace haptics
