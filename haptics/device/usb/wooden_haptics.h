// A WoodenHaptics (mbed HID firmware, 1234:0006) over libusb: 3 forces, position, orientation if it has a gimbal.
// Construction opens it, wakes it and waits until its user has homed it; then a report each way a tick, the tick as
// soon as a report came. Motors off is 0 mA for every motor: the firmware has no other switch, but disables its
// amplifiers 0.5 s after the last report; the USB event thread sends zero current after 20 ms of silence. No force
// while it is not homed or the line is not ok. Frame D as wooden_kinematics. Threads as HapticDevice. Its newtons
// follow from the published torque constants and capstans, not from a measurement. Never run on a real unit. Facts:
// reference/devices 3.1.
#pragma once

#include <optional>
#include <string_view>

#include "haptics/device/usb/usb_haptic_device.h"
#include "haptics/device/usb/wooden_homing.h"
#include "haptics/device/usb/wooden_kinematics.h"
#include "haptics/device/usb/wooden_model.h"

namespace haptics {

inline constexpr const char* kWoodenHomingPrompt =
    "hold the arm at its home position, turret straight ahead, upper arm upright, forearm level, and press the "
    "calibration switch";

struct WoodenSettings : UsbDeviceSettings {
  /// Of the published builds the one that a wrong guess makes weaker, not stronger.
  WoodenModel model = woodenHaptics2019();
};

/// "wooden", "wooden:1-2", "wooden:v2015", "wooden:1-2,v2015"; none for any other address.
std::optional<WoodenSettings> woodenAddressed(std::string_view address);

class WoodenHaptics final : public UsbHapticDevice {
 public:
  /// Opens, wakes, homes. Throws DeviceError with the next step when one of them fails.
  explicit WoodenHaptics(const WoodenSettings& settings);
  ~WoodenHaptics() override { stop(); }

  void start(DeviceServo& servo, double rate_Hz) override;
  /// The arm stands at its home position now. Any thread; ignored while the motors are on.
  void setHome() noexcept override { homing_.ask(); }

 private:
  HandleState sense(double dt_s) noexcept override;
  void drive(const MotorCommand& command) noexcept override;
  void await(std::int64_t deadline_ns) noexcept override;

  void wake();
  bool pollHoming();
  bool readReport() noexcept;

  WoodenModel model_;
  WoodenKinematics kinematics_;
  WoodenHoming homing_;
  std::int64_t period_ns_ = 0;

  // Of the device's thread.
  WoodenJoints joints_;
  std::int64_t received_ns_ = 0;
  bool motors_on_ = false;
};

}  // namespace haptics
