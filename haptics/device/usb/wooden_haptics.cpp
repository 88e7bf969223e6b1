#include "haptics/device/usb/wooden_haptics.h"

#include <chrono>
#include <cmath>

#include "haptics/device/monotonic_clock.h"
#include "haptics/device/opened_device.h"
#include "haptics/device/usb/wooden_protocol.h"

namespace haptics {
namespace {

using namespace std::chrono_literals;

/// While it is silent it is asked again as often (public driver), and for so long before that is an error.
constexpr std::chrono::milliseconds kWakeUp = 100ms, kAnswer = 1500ms;
/// Continuous to peak force as of a Touch (reference/devices 4.3); of these motors it is not published.
constexpr double kContinuousShare = 0.27;

}  // namespace

std::optional<WoodenSettings> woodenAddressed(std::string_view address) {
  WoodenSettings settings;
  const std::size_t colon = address.find(':');
  if (address.substr(0, colon) != "wooden") return {};
  if (colon == std::string_view::npos) return settings;
  std::string_view path = address.substr(colon + 1);
  const std::size_t comma = path.find(',');
  const std::string_view build = comma == std::string_view::npos ? path : path.substr(comma + 1);
  if (const auto model = woodenModelNamed(build)) {
    settings.model = *model;
    path = comma == std::string_view::npos ? std::string_view{} : path.substr(0, comma);
  }
  if (path.find_first_not_of("0123456789-.") != std::string_view::npos) return {};
  settings.path = path;
  return settings;
}

WoodenHaptics::WoodenHaptics(const WoodenSettings& settings)
    : UsbHapticDevice({kWoodenVendor, kWoodenProduct, settings.path, 0, "WoodenHaptics"}, settings, woodenRest()),
      model_(settings.model),
      kinematics_(model_),
      homing_(model_.home_counts, model_.hasGimbal()) {
  DeviceCapabilities& can = capabilities_;
  can.model = model_.name;
  can.has_orientation = model_.hasGimbal();
  can.peak_force_N = model_.peak_force_N;
  can.continuous_force_N = kContinuousShare * model_.peak_force_N;
  can.peak_joint_torque_Nmm = kinematics_.peakTorque_Nmm();
  can.max_stiffness_N_per_mm = model_.max_stiffness_N_per_mm;
  can.max_damping_Ns_per_mm = model_.max_damping_Ns_per_mm;
  can.workspace = {glm::dvec3(-model_.workspace_radius_mm), glm::dvec3(model_.workspace_radius_mm)};
  if (usb_->outPacketBytes() < kWoodenReportBytes)
    throw DeviceError(where() + "its packets hold no report, it is another device with the same id",
                      DeviceTrouble::faulty);
  UsbStream stream;
  stream.report_bytes = kWoodenReportBytes;
  beginStream(std::move(stream), woodenRest());
  wake();
  awaitHoming(
      kWoodenHomingPrompt, [this] { return pollHoming(); }, [this] { return !homing_.wantsPreset(); });
}

void WoodenHaptics::wake() {
  const UsbClock clock = usb_->clock();
  const std::int64_t deadline_ns = clock.now_ns() + toNs(kAnswer);
  while (clock.now_ns() < deadline_ns) {
    usb_->send(woodenRest(), usb_->rests());
    if (usb_->awaitReport(monotonic_ns() + toNs(kWakeUp))) return;
  }
  throw DeviceError(where() + "it does not answer, switch it off and on and start again", DeviceTrouble::faulty);
}

bool WoodenHaptics::pollHoming() {
  rests_ = usb_->rests();
  usb_->awaitReport(monotonic_ns() + toNs(kWakeUp));
  if (readReport() && homing_.isHome()) return true;
  drive({});
  return false;
}

void WoodenHaptics::start(DeviceServo& servo, double rate_Hz) {
  period_ns_ = std::llround(1e9 / rate_Hz);
  UsbHapticDevice::start(servo, rate_Hz);
}

void WoodenHaptics::await(std::int64_t deadline_ns) noexcept {
  // A report may come up to a quarter of a tick late without being missed, and no tick follows the last one at once.
  usb_->awaitReport(deadline_ns + period_ns_ / 4);
  const std::int64_t earliest_ns = deadline_ns - period_ns_ / 2;
  if (monotonic_ns() < earliest_ns) PacedDevice::await(earliest_ns);
}

HandleState WoodenHaptics::sense(double) noexcept {
  rests_ = usb_->rests();
  state_.fresh = readReport();
  state_.healthy = usb_->state() == UsbState::ok;
  state_.calibrated = homing_.isHome() && has_position_;
  return state_;
}

bool WoodenHaptics::readReport() noexcept {
  const UsbReport& newest = usb_->newestReport();
  if (newest.serial == serial_) return false;
  serial_ = newest.serial;
  const auto reading = decodeWoodenReading(newest.content());
  if (!reading) return false;
  const bool was_home = homing_.isHome();
  homing_.take(*reading, motors_on_);
  // A preset moves the pose, not the hand.
  has_position_ = has_position_ && was_home == homing_.isHome();
  joints_ = kinematics_.joints(reading->encoders);
  setPose(kinematics_.handle(joints_), 1e-9 * static_cast<double>(newest.received_ns - received_ns_));
  received_ns_ = newest.received_ns;
  state_.jacobian_D_mm = kinematics_.jacobian_mm(joints_.arm_rad);
  state_.buttons = reading->button ? 1 : 0;
  return true;
}

void WoodenHaptics::drive(const MotorCommand& command) noexcept {
  motors_on_ = command.motorsOn() && state_.calibrated && state_.healthy;
  // A report goes out every tick: the device answers reports and sends none by itself.
  if (homing_.wantsPreset())
    usb_->send(encodeWoodenPreset(homing_.homeCounts()), rests_);
  else if (motors_on_)
    usb_->send(encodeWoodenCurrents(kinematics_.currents_mA(joints_.arm_rad, command.wrench_D().force_N)), rests_);
  else
    usb_->send(woodenRest(), rests_);
}

OpenedDevice openWooden(const std::string& place, const DeviceOptions& options) {
  WoodenSettings settings = woodenAddressed("wooden:" + place).value();
  settings.servo_priority = options.servo_priority;
  settings.prompt = waitPrompt(options);
  return {nullptr, std::make_unique<WoodenHaptics>(settings), {}};
}

}  // namespace haptics
