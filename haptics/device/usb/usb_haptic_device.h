// What the devices driven over a UsbTransport share: start and stop, motors off, homing, the filtered velocity. Motors
// off is the stream's rest report (zero force), sent by the USB event thread. Velocity: differences of the measured
// positions behind one pole at 50 Hz; one encoder count a millisecond is up to 40 mm/s (Falcon) and 80 mm/s
// (WoodenHaptics), 10 and 20 after the filter. Frame D, mm, s. Threads as HapticDevice.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "haptics/device/paced_device.h"
#include "haptics/device/usb/usb_transport.h"

namespace haptics {

/// Shows what the user has to do now, or progress; called repeatedly. False: cancelled.
using DevicePrompt = std::function<bool(const std::string& words)>;

struct UsbDeviceSettings {
  std::string path;  ///< bus and ports, "1-2.3"; empty: the first device
  DevicePrompt prompt;
  std::chrono::seconds homing_patience{60};  ///< 0: does not wait, ticks uncalibrated until it is homed
  int servo_priority = kServoPriority;       ///< the USB event thread's lies one above
  UsbClock clock = {};
};

class UsbHapticDevice : public PacedDevice {
 public:
  const DeviceCapabilities& capabilities() const override { return capabilities_; }
  void start(DeviceServo& servo, double rate_Hz) override;
  void stop() noexcept override;
  void motorsOff() noexcept override;
  /// Any thread.
  UsbCounters counters() const noexcept { return usb_->counters(); }

 protected:
  /// Opens and claims the device; throws DeviceError. `last`: the report sent last of all.
  UsbHapticDevice(const UsbAddress& address, const UsbDeviceSettings& settings, const UsbReport& last);

  /// Begins to stream. `rest`: zero force, also sent after 20 ms without a report.
  void beginStream(UsbStream stream, const UsbReport& rest);
  /// Polls until `is_homed`, and shows `words` while the user has to act. Throws DeviceError: unplugged, cancelled, out
  /// of patience.
  void awaitHoming(const char* words, const std::function<bool()>& is_homed, const std::function<bool()>& user_acts);
  /// The pose of a new report, measured `since_s` after the last one; none: the last pose stands, velocity 0.
  void setPose(const std::optional<calibration::Pose<calibration::Device, calibration::Handle>>& X_DH,
               double since_s) noexcept;
  /// "Novint Falcon on USB 1-2, "
  std::string where() const { return capabilities_.model + " on USB " + usb_->path() + ", "; }

  const UsbDeviceSettings settings_;
  std::unique_ptr<UsbTransport> usb_;
  DeviceCapabilities capabilities_;
  // Of the device's thread.
  HandleState state_;
  std::uint64_t serial_ = 0;   ///< of the newest report read
  std::uint32_t rests_ = 0;    ///< when the current command began to be made; a later rest voids it
  bool has_position_ = false;  ///< the last report gave one

 private:
  UsbReport last_;
};

}  // namespace haptics
