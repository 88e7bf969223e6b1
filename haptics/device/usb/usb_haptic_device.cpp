#include "haptics/device/usb/usb_haptic_device.h"

#include <cmath>
#include <utility>

#include "calibration/geometry/units.h"

namespace haptics {
namespace {

using namespace std::chrono_literals;

constexpr auto kRestAfter = 20ms, kLastReportTime = 50ms;
constexpr double kVelocityCutoff_Hz = 50.0;

}  // namespace

UsbHapticDevice::UsbHapticDevice(const UsbAddress& address, const UsbDeviceSettings& settings, const UsbReport& last)
    : settings_(settings), usb_(std::make_unique<UsbTransport>(address, settings.clock)), last_(last) {
  capabilities_.model = address.called;
  capabilities_.serial = usb_->serialNumber();
  capabilities_.provenance = Provenance::public_protocol;
  capabilities_.has_motors = true;
  capabilities_.min_rate_Hz = 500.0;
  capabilities_.max_rate_Hz = 1000.0;  // USB full speed: a report each way a millisecond
  state_.calibrated = false;
}

void UsbHapticDevice::beginStream(UsbStream stream, const UsbReport& rest) {
  stream.rest = rest;
  stream.rest_after = kRestAfter;
  stream.priority = usbPriority(settings_.servo_priority);
  usb_->run(stream);
}

void UsbHapticDevice::awaitHoming(const char* words, const std::function<bool()>& is_homed,
                                  const std::function<bool()>& user_acts) {
  if (settings_.homing_patience == 0s) return;
  const UsbClock clock = usb_->clock();
  const std::int64_t deadline_ns = clock.now_ns() + toNs(settings_.homing_patience);
  while (clock.now_ns() < deadline_ns) {
    if (is_homed()) return;
    if (usb_->state() == UsbState::gone)
      throw DeviceError(where() + "unplugged while it was homed, plug it in again", DeviceTrouble::not_there);
    if (user_acts() && settings_.prompt && !settings_.prompt(words))
      throw DeviceError(where() + "not homed, given up, start again", DeviceTrouble::not_ready);
  }
  throw DeviceError(where() + "not homed, start again and " + words, DeviceTrouble::not_ready);
}

void UsbHapticDevice::start(DeviceServo& servo, double rate_Hz) {
  if (usb_->state() == UsbState::gone)
    throw DeviceError(where() + "unplugged, plug it in and start again", DeviceTrouble::not_there);
  PacedDevice::start(servo, rate_Hz);
}

void UsbHapticDevice::stop() noexcept {
  // Before the wait for the servo, which may hang.
  usb_->sendLast(last_, kLastReportTime);
  PacedDevice::stop();
  usb_->stop();
}

void UsbHapticDevice::motorsOff() noexcept {
  PacedDevice::motorsOff();
  usb_->rest();
}

void UsbHapticDevice::setPose(const std::optional<calibration::Pose<calibration::Device, calibration::Handle>>& X_DH,
                              double since_s) noexcept {
  glm::dvec3& velocity = state_.velocity_D_mm_per_s.xyz;
  const bool continues = std::exchange(has_position_, X_DH.has_value()) && X_DH && since_s > 0.0;
  if (continues) {
    const double blend = 1.0 - std::exp(-2.0 * calibration::kPi * kVelocityCutoff_Hz * since_s);
    velocity += blend * ((X_DH->translation_mm - state_.X_DH.translation_mm) / since_s - velocity);
  } else {
    velocity = glm::dvec3(0.0);
  }
  if (X_DH) state_.X_DH = *X_DH;
}

}  // namespace haptics
