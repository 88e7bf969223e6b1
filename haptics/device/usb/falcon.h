// The Novint Falcon over libusb: three degrees of freedom, three forces, four buttons, no orientation. Opened, its
// program loaded where it has lost it (the user's file), homed by its owner's hand; then one packet out and one in a
// tick, and never a second question before the first is answered, but for one that lets go. The force is a guess until
// a FalconForceScale says otherwise, and is then held down. Frame D as falcon_kinematics; the handle never turns in it.
// Threads as HapticDevice. Lights: red not homed, green homed, blue motors on. What the unit does when packets stop is
// not published: after 20 ms of silence the USB's own thread lets go. Never run on a real unit. Protocol:
// falcon_protocol.
#pragma once

#include <array>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "haptics/device/found_device.h"
#include "haptics/device/paced_device.h"
#include "haptics/device/thread_priority.h"
#include "haptics/device/usb/falcon_force_scale.h"
#include "haptics/device/usb/falcon_start.h"
#include "haptics/device/usb/usb_clock.h"

namespace haptics {

class UsbTransport;
struct FalconReport;

struct FalconSettings {
  std::string path;               ///< bus and ports, "1-2.3"; empty: the first
  std::filesystem::path program;  ///< Novint's firmware; needed after every power-up
  FalconForceScale scale;
  FalconProgress tell;                       ///< progress and what the owner shall do
  std::chrono::seconds homing_patience{60};  ///< 0: does not wait, ticks uncalibrated until it is homed
  int greetings = 100;                       ///< of the boot loader
  int servo_priority = kServoPriority;       ///< the thread that reads its USB lies next to it
  UsbClock clock = {};
};

class Falcon final : public PacedDevice {
 public:
  /// Opens, loads, homes. Throws DeviceError with the next step when one of them fails.
  explicit Falcon(const FalconSettings& settings);
  ~Falcon() override;

  const DeviceCapabilities& capabilities() const override { return capabilities_; }
  void start(DeviceServo& servo, double rate_Hz) override;
  void stop() noexcept override;
  void motorsOff() noexcept override;

 private:
  HandleState sense(double dt_s) noexcept override;
  void drive(const MotorCommand& command) noexcept override;
  void await(std::int64_t deadline_ns) noexcept override;

  void awaitHoming(const FalconSettings& settings);
  void take(const FalconReport& report, double since_s) noexcept;
  std::array<int, 3> wordsFor(const MotorCommand& command) const noexcept;

  std::unique_ptr<UsbTransport> usb_;
  FalconForceScale scale_;
  DeviceCapabilities capabilities_;
  std::int64_t longest_wait_ns_ = 0;  ///< past a deadline, for an answer

  // Of the device's thread.
  HandleState state_;
  std::uint64_t serial_ = 0;
  double silent_s_ = 0.0, since_report_s_ = 0.0, since_question_s_ = 0.0;
  bool question_open_ = false, pushed_ = false, homed_ = false, has_place_ = false;
  std::uint32_t rests_ = 0;
};

/// Without opening anything. Throws DeviceError when USB can not be looked at.
std::vector<FoundDevice> findFalcon();

}  // namespace haptics
