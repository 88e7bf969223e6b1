// The Novint Falcon over libusb: position of 3 axes, 3 forces, 4 buttons, no orientation. Construction opens it, loads
// its firmware if it has lost it (the user's file) and waits until its user has homed it; then one packet out and one
// in a tick, and no second packet before the answer to the first, except the one that ends a force. The force scale is
// a guess, with the force kept low, until a FalconForceScale is given. Frame D as falcon_kinematics, mm. Threads as
// HapticDevice. Lights: red not homed, green homed, blue motors on. After 20 ms without a packet the USB event thread
// sends zero force: what the unit does by itself is not published. Never run on a real unit. Protocol: falcon_protocol.
#pragma once

#include <array>
#include <filesystem>

#include "haptics/device/usb/falcon_force_scale.h"
#include "haptics/device/usb/usb_haptic_device.h"

namespace haptics {

struct FalconReport;

struct FalconSettings : UsbDeviceSettings {
  std::filesystem::path program;  ///< Novint's firmware; needed after every power-up
  FalconForceScale scale;
  int greetings = 100;  ///< attempts to reach the boot loader
};

class Falcon final : public UsbHapticDevice {
 public:
  /// Opens, loads, homes. Throws DeviceError with the next step when one of them fails.
  explicit Falcon(const FalconSettings& settings);
  ~Falcon() override { stop(); }

  void start(DeviceServo& servo, double rate_Hz) override;

 private:
  HandleState sense(double dt_s) noexcept override;
  void drive(const MotorCommand& command) noexcept override;
  void await(std::int64_t deadline_ns) noexcept override;

  void loadProgram(const FalconSettings& settings);
  bool pollHoming();
  void take(const FalconReport& report, double since_s) noexcept;
  std::array<int, 3> motorWords(const MotorCommand& command) const noexcept;

  FalconForceScale scale_;
  std::int64_t longest_wait_ns_ = 0;  ///< past a deadline, for an answer

  // Of the device's thread.
  double silent_s_ = 0.0, since_report_s_ = 0.0, since_question_s_ = 0.0;
  bool question_open_ = false, pushed_ = false, homed_ = false;
};

}  // namespace haptics
