#include "haptics/device/usb/wooden_haptics.h"

#include <algorithm>
#include <cmath>

#include "calibration/geometry/units.h"
#include "haptics/device/monotonic_clock.h"
#include "haptics/device/usb/smoothed_velocity.h"
#include "haptics/device/usb/usb_devices.h"
#include "haptics/device/usb/usb_transport.h"
#include "haptics/device/usb/wooden_protocol.h"

namespace haptics {
namespace {

using namespace std::chrono_literals;

/// Asked again as often while it is silent (public driver), and for so long before it is given up.
constexpr std::chrono::milliseconds kWakeUp = 100ms, kAnswer = 1500ms, kRestAfter = 20ms, kLastReportTime = 50ms;
/// Continuous to peak force as of a Touch (reference/devices 4.3); of these motors it is not published.
constexpr double kContinuousShare = 0.27;
constexpr std::int64_t kSecond_ns = 1'000'000'000;

/// By the machine's clock, unless by another.
std::int64_t after(std::chrono::milliseconds time, const UsbClock& clock = {}) {
  return clock.now_ns() + std::chrono::nanoseconds(time).count();
}

DeviceCapabilities capabilitiesOf(const WoodenModel& model, const std::string& serial) {
  DeviceCapabilities can;
  can.model = model.name;
  can.serial = serial;
  can.provenance = Provenance::public_protocol;
  can.has_motors = true;
  can.has_orientation = model.hasGimbal();
  can.peak_force_N = model.peak_force_N;
  can.continuous_force_N = kContinuousShare * model.peak_force_N;
  can.peak_joint_torque_Nmm = WoodenKinematics(model).peakTorque_Nmm();
  can.max_stiffness_N_per_mm = model.max_stiffness_N_per_mm;
  can.max_damping_Ns_per_mm = model.max_damping_Ns_per_mm;
  can.min_rate_Hz = 500.0;
  can.max_rate_Hz = 1000.0;  // USB full speed: a report each way a millisecond
  can.workspace = {glm::dvec3(-model.workspace_radius_mm), glm::dvec3(model.workspace_radius_mm)};
  return can;
}

UsbStream woodenStream(int servo_priority) {
  UsbStream stream;
  stream.priority = usbPriority(servo_priority);
  stream.report_bytes = kWoodenReportBytes;
  stream.rest = woodenRest();
  stream.rest_after = kRestAfter;
  return stream;
}

}  // namespace

std::optional<WoodenSettings> woodenAddressed(std::string_view address) {
  WoodenSettings settings;
  const std::size_t colon = address.find(':');
  if (address.substr(0, colon) != "wooden") return {};
  if (colon == std::string_view::npos) return settings;
  std::string_view place = address.substr(colon + 1);
  const std::size_t comma = place.find(',');
  const std::string_view build = comma == std::string_view::npos ? place : place.substr(comma + 1);
  if (const auto model = woodenModelNamed(build)) {
    settings.model = *model;
    place = comma == std::string_view::npos ? std::string_view{} : place.substr(0, comma);
  }
  if (place.find_first_not_of("0123456789-.") != std::string_view::npos) return {};
  settings.path = place;
  return settings;
}

WoodenHaptics::WoodenHaptics(const WoodenSettings& settings)
    : model_(settings.model),
      kinematics_(model_),
      homing_(model_.home_counts, model_.hasGimbal()),
      usb_(std::make_unique<UsbTransport>(UsbAddress{kWoodenVendor, kWoodenProduct, settings.path, 0, "WoodenHaptics"},
                                          settings.clock)),
      capabilities_(capabilitiesOf(model_, usb_->serialNumber())) {
  if (usb_->outPacketBytes() < kWoodenReportBytes)
    throw DeviceError(where() + "its packets hold no report, it is another device with the same id",
                      DeviceTrouble::faulty);
  state_.calibrated = false;
  usb_->run(woodenStream(settings.servo_priority));
  wake();
  if (settings.homing_patience > 0s) awaitHoming(settings);
}

WoodenHaptics::~WoodenHaptics() { stop(); }

std::string WoodenHaptics::where() const { return model_.name + " on USB " + usb_->path() + ", "; }

void WoodenHaptics::wake() {
  const UsbClock clock = usb_->clock();
  const std::int64_t deadline_ns = after(kAnswer, clock);
  while (clock.now_ns() < deadline_ns) {
    usb_->send(woodenRest(), usb_->rests());
    if (usb_->awaitReport(after(kWakeUp))) return;
  }
  throw DeviceError(where() + "it does not answer, switch it off and on and start again", DeviceTrouble::faulty);
}

void WoodenHaptics::awaitHoming(const WoodenSettings& settings) {
  const UsbClock clock = usb_->clock();
  const std::int64_t deadline_ns = after(settings.homing_patience, clock);
  while (clock.now_ns() < deadline_ns) {
    rests_ = usb_->rests();
    usb_->awaitReport(after(kWakeUp));
    if (listen() && homing_.isHome()) return;
    drive({});
    if (usb_->state() == UsbState::gone)
      throw DeviceError(where() + "unplugged while it was homed, plug it in again", DeviceTrouble::not_there);
    if (homing_.wantsPreset() || !settings.tell) continue;
    const HomingAnswer answer = settings.tell(kWoodenHomingPrompt);
    if (answer == HomingAnswer::stands_at_home) setHome();
    if (answer == HomingAnswer::give_up)
      throw DeviceError(where() + "not homed, given up, start again", DeviceTrouble::not_ready);
  }
  throw DeviceError(where() + "not homed, start again and " + kWoodenHomingPrompt, DeviceTrouble::not_ready);
}

void WoodenHaptics::start(DeviceServo& servo, double rate_Hz) {
  if (usb_->state() == UsbState::gone)
    throw DeviceError(where() + "unplugged, plug it in and start again", DeviceTrouble::not_there);
  period_ns_ = std::llround(static_cast<double>(kSecond_ns) / rate_Hz);
  PacedDevice::start(servo, rate_Hz);
}

void WoodenHaptics::stop() noexcept {
  // Before the servo is waited for, which may hang.
  usb_->sendLast(woodenRest(), kLastReportTime);
  PacedDevice::stop();
  usb_->stop();
}

void WoodenHaptics::motorsOff() noexcept {
  PacedDevice::motorsOff();
  usb_->rest();
}

UsbCounters WoodenHaptics::counters() const noexcept { return usb_->counters(); }

void WoodenHaptics::await(std::int64_t deadline_ns) noexcept {
  // A report may come up to a quarter of a tick late without being missed, and no tick follows the last one at once.
  usb_->awaitReport(deadline_ns + period_ns_ / 4);
  const std::int64_t earliest_ns = deadline_ns - period_ns_ / 2;
  if (monotonic_ns() < earliest_ns) PacedDevice::await(earliest_ns);
}

HandleState WoodenHaptics::sense(double) noexcept {
  // A command made from now on is void after a rest from now on.
  rests_ = usb_->rests();
  state_.fresh = listen();
  state_.healthy = usb_->state() == UsbState::ok;
  state_.calibrated = homing_.isHome() && has_place_;
  return state_;
}

bool WoodenHaptics::listen() noexcept {
  const UsbReport& newest = usb_->newestReport();
  if (newest.serial == serial_) return false;
  serial_ = newest.serial;
  const auto reading = decodeWoodenReading(newest.content());
  if (!reading) return false;
  const bool was_home = homing_.isHome();
  homing_.take(*reading, motors_on_);
  has_place_ = has_place_ && was_home == homing_.isHome();
  move(*reading, newest.received_ns);
  return true;
}

void WoodenHaptics::move(const WoodenReading& reading, std::int64_t received_ns) noexcept {
  joints_ = kinematics_.joints(reading.encoders);
  const auto X_DH = kinematics_.handle(joints_);
  const double since_s = static_cast<double>(received_ns - received_ns_) / static_cast<double>(kSecond_ns);
  if (has_place_)
    follow(state_.velocity_D_mm_per_s, X_DH.translation_mm - state_.X_DH.translation_mm, since_s);
  else
    state_.velocity_D_mm_per_s = {};
  state_.X_DH = X_DH;
  state_.jacobian_D_mm = kinematics_.jacobian_mm(joints_.arm_rad);
  state_.buttons = reading.button ? 1 : 0;
  received_ns_ = received_ns;
  has_place_ = true;
}

void WoodenHaptics::drive(const MotorCommand& command) noexcept {
  motors_on_ = command.motorsOn() && state_.calibrated && state_.healthy;
  // Something goes out every tick: it answers reports, and says nothing by itself.
  if (homing_.wantsPreset())
    usb_->send(encodeWoodenPreset(homing_.homeCounts()), rests_);
  else if (motors_on_)
    usb_->send(encodeWoodenCurrents(kinematics_.currents_mA(joints_.arm_rad, command.wrench_D().force_N)), rests_);
  else
    usb_->send(woodenRest(), rests_);
}

std::vector<FoundDevice> findWoodenHaptics() {
  std::vector<FoundDevice> found;
  for (const UsbDevice& device : UsbBus().devices()) {
    if (device.vendor != kWoodenVendor || device.product != kWoodenProduct) continue;
    FoundDevice wooden;
    wooden.name = "WoodenHaptics";
    wooden.address = "wooden:" + device.path;
    wooden.place = device.place();
    wooden.provenance = Provenance::public_protocol;
    wooden.driver = "libusb";
    if (!device.may_open)
      wooden.advice = "install the udev rules that `molar doctor --udev-rules` prints and replug it";
    found.push_back(wooden);
  }
  return found;
}

}  // namespace haptics
