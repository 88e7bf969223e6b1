#include "haptics/device/usb/falcon.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "calibration/geometry/units.h"
#include "haptics/device/monotonic_clock.h"
#include "haptics/device/usb/falcon_kinematics.h"
#include "haptics/device/usb/falcon_program.h"
#include "haptics/device/usb/falcon_protocol.h"
#include "haptics/device/usb/smoothed_velocity.h"
#include "haptics/device/usb/usb_devices.h"
#include "haptics/device/usb/usb_transport.h"

namespace haptics {
namespace {

using namespace std::chrono_literals;

/// Without an answer for so long it is not healthy; a question older than this is asked again.
constexpr double kSilent_s = 0.02, kAskAgain_s = 0.005;
constexpr auto kLastPacketTime = 50ms;
/// The unit is not known to let go by itself: without a packet for so long the USB's own thread does.
constexpr auto kRestAfter = 20ms;
/// Continuous to peak force as of a Touch (reference/devices 4.3); the Falcon's is not published.
constexpr double kContinuousShare = 0.27;
constexpr const char* kHomingWords =
    "pull the Falcon's grip all the way out, then push it straight in, until its lights turn green";

UsbReport reportOf(const FalconCommand& command) { return UsbReport(encoded(command)); }

DeviceCapabilities capabilitiesOf(const FalconForceScale& scale, const std::string& serial) {
  DeviceCapabilities can;
  can.model = "Novint Falcon";
  can.serial = serial;
  can.provenance = Provenance::public_protocol;
  can.has_motors = true;
  can.has_orientation = false;
  can.force_is_calibrated = scale.isWeighed();
  can.peak_force_N = falconPeakForce_N(scale);
  can.continuous_force_N = kContinuousShare * can.peak_force_N;
  can.peak_joint_torque_Nmm = glm::dvec3(falconPeakTorque_Nmm(scale));
  can.max_stiffness_N_per_mm = 3.0;  // reference/product, device reality
  can.min_rate_Hz = 500.0;
  can.max_rate_Hz = 1000.0;  // a packet each way through a bridge that hands over once a millisecond
  can.workspace = {{-50.0, -50.0, 75.0}, {50.0, 50.0, 165.0}};
  return can;
}

UsbStream falconStream(int servo_priority) {
  UsbStream stream;
  stream.priority = usbPriority(servo_priority);
  stream.reader = [line = FalconStream()](std::span<const std::uint8_t> transfer) mutable -> std::optional<UsbReport> {
    std::array<std::uint8_t, UsbReport::kMaxBytes> payload;
    if (transfer.size() > payload.size()) return {};
    const auto packet = line.take(std::span(payload).first(ftdiPayload(transfer, payload)));
    return packet ? std::optional(UsbReport(*packet)) : std::nullopt;
  };
  stream.rest = reportOf({{}, true, FalconLights::green});
  stream.rest_after = kRestAfter;
  stream.late_after = std::chrono::milliseconds(std::lround(1e3 * kSilent_s));
  return stream;
}

}  // namespace

Falcon::Falcon(const FalconSettings& settings) : scale_(settings.scale) {
  check(scale_);
  const auto program = settings.program.empty() ? std::vector<std::uint8_t>{} : readFalconProgram(settings.program);
  usb_ = std::make_unique<UsbTransport>(UsbAddress{kFalconVendor, kFalconProduct, settings.path, 0, "Novint Falcon"},
                                        settings.clock);
  if (!scale_.serial.empty() && scale_.serial != usb_->serialNumber())
    throw DeviceError("Falcon on USB " + usb_->path() + ", its force scale was weighed on unit " + scale_.serial +
                      " and this is " + usb_->serialNumber() + ", weigh this one or run it without");
  capabilities_ = capabilitiesOf(scale_, usb_->serialNumber());
  state_.X_DH.translation_mm = falconMiddle().mm;
  state_.calibrated = false;
  if (!falconRuns(*usb_)) {
    if (program.empty())
      throw DeviceError("Falcon on USB " + usb_->path() +
                            ", it loses its program with every power-down and no file is named, give the firmware of "
                            "Novint's driver with --falcon-firmware",
                        DeviceTrouble::no_driver);
    loadFalcon(*usb_, program, settings.tell, settings.greetings);
  }
  usb_->run(falconStream(settings.servo_priority));
  if (settings.homing_patience > 0s) awaitHoming(settings);
}

Falcon::~Falcon() { stop(); }

void Falcon::awaitHoming(const FalconSettings& settings) {
  const UsbClock clock = usb_->clock();
  const std::int64_t deadline_ns = clock.now_ns() + std::chrono::nanoseconds(settings.homing_patience).count();
  const std::string where = "Falcon on USB " + usb_->path() + ", ";
  while (clock.now_ns() < deadline_ns) {
    usb_->send(reportOf({{}, true, FalconLights::red}), usb_->rests());
    usb_->awaitReport(monotonic_ns() + std::chrono::nanoseconds(20ms).count());
    const auto report = decodeFalconReport(usb_->newestReport().content());
    if (report && report->isHomed()) return;
    if (usb_->state() == UsbState::gone)
      throw DeviceError(where + "unplugged while it was homed, plug it in again", DeviceTrouble::not_there);
    const int legs = report ? std::popcount(report->homed) : 0;
    if (settings.tell && !settings.tell(kHomingWords, legs / 3.0))
      throw DeviceError(where + "not homed, given up, start again", DeviceTrouble::not_ready);
  }
  throw DeviceError(where + "not homed, start again and " + kHomingWords, DeviceTrouble::not_ready);
}

void Falcon::start(DeviceServo& servo, double rate_Hz) {
  if (usb_->state() == UsbState::gone)
    throw DeviceError("Falcon on USB " + usb_->path() + ", unplugged, plug it in and start again",
                      DeviceTrouble::not_there);
  longest_wait_ns_ = std::llround(0.5e9 / rate_Hz);
  serial_ = usb_->newestReport().serial;  // what it said while it was homed is old
  PacedDevice::start(servo, rate_Hz);
}

void Falcon::stop() noexcept {
  // Before the servo is waited for, which may hang.
  usb_->sendLast(reportOf({{}, true, FalconLights::none}), kLastPacketTime);
  PacedDevice::stop();
  usb_->stop();
}

void Falcon::motorsOff() noexcept {
  PacedDevice::motorsOff();
  usb_->rest();
}

void Falcon::await(std::int64_t deadline_ns) noexcept {
  PacedDevice::await(deadline_ns);
  // An answer that is about to come is worth half a tick.
  if (question_open_ && usb_->state() == UsbState::ok) usb_->awaitReport(deadline_ns + longest_wait_ns_);
}

HandleState Falcon::sense(double dt_s) noexcept {
  // A command made from now on is void after a rest from now on.
  rests_ = usb_->rests();
  const UsbReport& newest = usb_->newestReport();
  silent_s_ += dt_s;
  since_report_s_ += dt_s;
  since_question_s_ += dt_s;
  state_.fresh = newest.serial != serial_;
  if (state_.fresh) {
    serial_ = newest.serial;
    question_open_ = false;
    silent_s_ = 0.0;
    if (const auto report = decodeFalconReport(newest.content())) take(*report, since_report_s_);
    since_report_s_ = 0.0;
  }
  const UsbState line = usb_->state();
  state_.healthy = line != UsbState::gone && line != UsbState::stalled && silent_s_ < kSilent_s;
  state_.calibrated = homed_ && has_place_;
  return state_;
}

void Falcon::take(const FalconReport& report, double since_s) noexcept {
  state_.buttons = report.buttons;
  homed_ = report.isHomed();
  const calibration::Point<calibration::Device> last_D{state_.X_DH.translation_mm};
  const FalconLegs legs_rad = falconLegs_rad(report.encoders);
  auto grip_D = falconGrip(legs_rad, last_D);
  if (!grip_D) grip_D = falconGrip(legs_rad, falconMiddle());
  const bool goes_on = has_place_;
  has_place_ = grip_D.has_value();
  state_.jacobian_D_mm = grip_D ? falconJacobian_mm(legs_rad, *grip_D) : glm::dmat3(0.0);
  if (grip_D && goes_on)
    follow(state_.velocity_D_mm_per_s, grip_D->mm - last_D.mm, since_s);
  else
    state_.velocity_D_mm_per_s = {};
  if (grip_D) state_.X_DH.translation_mm = grip_D->mm;
}

std::array<int, 3> Falcon::wordsFor(const MotorCommand& command) const noexcept {
  if (!command.motorsOn() || !state_.calibrated || !state_.healthy) return {};
  // The motors pull against their words (public code's sign); beyond the range all go down alike.
  glm::dvec3 words = -scale_.words_per_Nmm * (glm::transpose(state_.jacobian_D_mm) * command.wrench_D().force_N.xyz);
  if (!std::isfinite(glm::length(words))) return {};
  const double largest = glm::max(std::abs(words.x), glm::max(std::abs(words.y), std::abs(words.z)));
  const double most = falconMaxWord(scale_);
  if (largest > most) words *= most / largest;
  const auto whole = [](double word) { return static_cast<int>(std::trunc(word)); };
  return {whole(words.x), whole(words.y), whole(words.z)};
}

void Falcon::drive(const MotorCommand& command) noexcept {
  FalconCommand wanted;
  wanted.motor_words = wordsFor(command);
  const bool pushes = wanted.motor_words != std::array<int, 3>{};
  wanted.lights = !homed_ ? FalconLights::red : command.motorsOn() ? FalconLights::blue : FalconLights::green;
  // One question at a time; letting go does not wait for the answer.
  const bool lets_go = pushed_ && !pushes;
  if (question_open_ && !lets_go && since_question_s_ < kAskAgain_s) return;
  usb_->send(reportOf(wanted), rests_);
  question_open_ = true;
  pushed_ = pushes;
  since_question_s_ = 0.0;
}

std::vector<FoundDevice> findFalcon() {
  std::vector<FoundDevice> found;
  for (const UsbDevice& device : UsbBus().devices()) {
    if (device.vendor != kFalconVendor || device.product != kFalconProduct) continue;
    FoundDevice falcon;
    falcon.name = "Novint Falcon";
    falcon.address = "falcon:" + device.path;
    falcon.place = device.place();
    falcon.driver = "libusb";
    falcon.advice = device.may_open
                        ? "give its firmware with --falcon-firmware, it forgets its program with every power-down; " +
                              falconForceAdvice({})
                        : "install the udev rules that `molar doctor --udev-rules` prints and replug it";
    found.push_back(falcon);
  }
  return found;
}

}  // namespace haptics
