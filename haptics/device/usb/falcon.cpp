#include "haptics/device/usb/falcon.h"

#include <algorithm>
#include <cmath>

#include "haptics/device/monotonic_clock.h"
#include "haptics/device/opened_device.h"
#include "haptics/device/usb/falcon_kinematics.h"
#include "haptics/device/usb/falcon_protocol.h"
#include "haptics/device/usb/falcon_start.h"

namespace haptics {
namespace {

using namespace std::chrono_literals;

/// Without an answer for so long it is not healthy; a question older than kAskAgain_s is asked again.
constexpr double kSilent_s = 0.02, kAskAgain_s = 0.005;
/// Continuous to peak force as of a Touch (reference/devices 4.3); the Falcon's is not published.
constexpr double kContinuousShare = 0.27;
constexpr const char* kHomingPrompt =
    "pull the Falcon's grip all the way out, then push it straight in, until its lights turn green";

UsbReport reportOf(const FalconCommand& command) { return UsbReport(encoded(command)); }

UsbStream falconStream() {
  UsbStream stream;
  stream.reader = [line = FalconStream()](std::span<const std::uint8_t> transfer) mutable -> std::optional<UsbReport> {
    std::array<std::uint8_t, UsbReport::kMaxBytes> payload;
    if (transfer.size() > payload.size()) return {};
    const auto packet = line.take(std::span(payload).first(ftdiPayload(transfer, payload)));
    return packet ? std::optional(UsbReport(*packet)) : std::nullopt;
  };
  stream.late_after = std::chrono::milliseconds(std::lround(1e3 * kSilent_s));
  return stream;
}

}  // namespace

Falcon::Falcon(const FalconSettings& settings)
    : UsbHapticDevice({kFalconVendor, kFalconProduct, settings.path, 0, "Novint Falcon"}, settings,
                      reportOf({{}, true, FalconLights::none})),
      scale_(settings.scale) {
  check(scale_);
  if (!scale_.serial.empty() && scale_.serial != capabilities_.serial)
    throw DeviceError(where() + "its force scale was weighed on unit " + scale_.serial + " and this is " +
                      capabilities_.serial + ", weigh this one or run it without");
  DeviceCapabilities& can = capabilities_;
  can.has_orientation = false;
  can.force_is_calibrated = scale_.isWeighed();
  can.peak_force_N = falconPeakForce_N(scale_);
  can.continuous_force_N = kContinuousShare * can.peak_force_N;
  can.peak_joint_torque_Nmm = glm::dvec3(falconPeakTorque_Nmm(scale_));
  can.max_stiffness_N_per_mm = 3.0;  // reference/product, device reality
  can.workspace = {{-50.0, -50.0, 75.0}, {50.0, 50.0, 165.0}};
  state_.X_DH.translation_mm = falconMiddle().mm;
  loadProgram(settings);
  beginStream(falconStream(), reportOf({{}, true, FalconLights::green}));
  awaitHoming(
      kHomingPrompt, [this] { return pollHoming(); }, [] { return true; });
}

void Falcon::loadProgram(const FalconSettings& settings) {
  const auto program = settings.program.empty() ? std::vector<std::uint8_t>{} : readFalconProgram(settings.program);
  if (falconRuns(*usb_)) return;
  if (program.empty())
    throw DeviceError(where() +
                          "it loses its program with every power-down and no file is named, give the firmware of "
                          "Novint's driver with --falcon-firmware",
                      DeviceTrouble::no_driver);
  loadFalcon(*usb_, program, settings.prompt, settings.greetings);
}

bool Falcon::pollHoming() {
  usb_->send(reportOf({{}, true, FalconLights::red}), usb_->rests());
  usb_->awaitReport(monotonic_ns() + toNs(20ms));
  const auto report = decodeFalconReport(usb_->newestReport().content());
  return report && report->isHomed();
}

void Falcon::start(DeviceServo& servo, double rate_Hz) {
  longest_wait_ns_ = std::llround(0.5e9 / rate_Hz);
  serial_ = usb_->newestReport().serial;  // reports from homing are old
  UsbHapticDevice::start(servo, rate_Hz);
}

void Falcon::await(std::int64_t deadline_ns) noexcept {
  PacedDevice::await(deadline_ns);
  // An answer that is due is worth half a tick.
  if (question_open_ && usb_->state() == UsbState::ok) usb_->awaitReport(deadline_ns + longest_wait_ns_);
}

HandleState Falcon::sense(double dt_s) noexcept {
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
  state_.calibrated = homed_ && has_position_;
  return state_;
}

void Falcon::take(const FalconReport& report, double since_s) noexcept {
  state_.buttons = report.buttons;
  homed_ = report.isHomed();
  const FalconLegs legs_rad = falconLegs_rad(report.encoders);
  auto grip_D = falconGrip(legs_rad, {state_.X_DH.translation_mm});
  if (!grip_D) grip_D = falconGrip(legs_rad, falconMiddle());
  state_.jacobian_D_mm = grip_D ? falconJacobian_mm(legs_rad, *grip_D) : glm::dmat3(0.0);
  auto X_DH = std::optional(state_.X_DH);
  if (grip_D)
    X_DH->translation_mm = grip_D->mm;
  else
    X_DH.reset();
  setPose(X_DH, since_s);
}

std::array<int, 3> Falcon::motorWords(const MotorCommand& command) const noexcept {
  if (!command.motorsOn() || !state_.calibrated || !state_.healthy) return {};
  // The motors pull against their words (public code's sign). Beyond the range all three are scaled alike.
  glm::dvec3 words = -scale_.words_per_Nmm * (glm::transpose(state_.jacobian_D_mm) * command.wrench_D().force_N.xyz);
  if (!std::isfinite(glm::length(words))) return {};
  const double largest = glm::max(std::abs(words.x), glm::max(std::abs(words.y), std::abs(words.z)));
  words *= std::min(1.0, falconMaxWord(scale_) / largest);
  const auto whole = [](double word) { return static_cast<int>(std::trunc(word)); };
  return {whole(words.x), whole(words.y), whole(words.z)};
}

void Falcon::drive(const MotorCommand& command) noexcept {
  FalconCommand wanted;
  wanted.motor_words = motorWords(command);
  const bool pushes = wanted.motor_words != std::array<int, 3>{};
  wanted.lights = !homed_ ? FalconLights::red : command.motorsOn() ? FalconLights::blue : FalconLights::green;
  // One question at a time; the end of a force does not wait for the answer.
  const bool ends_force = pushed_ && !pushes;
  if (question_open_ && !ends_force && since_question_s_ < kAskAgain_s) return;
  usb_->send(reportOf(wanted), rests_);
  question_open_ = true;
  pushed_ = pushes;
  since_question_s_ = 0.0;
}

OpenedDevice openFalcon(const std::string& place, const DeviceOptions& options) {
  FalconSettings settings;
  settings.path = place;
  settings.prompt = waitPrompt(options);
  settings.servo_priority = options.servo_priority;
  settings.program = options.falcon_program;
  settings.scale = options.falcon_scale();
  return {nullptr, std::make_unique<Falcon>(settings), {}};
}

}  // namespace haptics
