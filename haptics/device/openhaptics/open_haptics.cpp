#include "haptics/device/openhaptics/open_haptics.h"

#include <cassert>
#include <chrono>
#include <cmath>
#include <thread>

#include "haptics/device/monotonic_clock.h"
#include "haptics/device/opened_device.h"

namespace haptics {
namespace {

/// Longest wait for the last frame; a scheduler that does not call is stopped without.
constexpr auto kMaxShutdown = std::chrono::milliseconds(500);
constexpr double kWarmFor_s = 1.0;  ///< how long one warning of warm motors counts

}  // namespace

OpenHaptics::OpenHaptics(const HdLibrary& library, const OpenHapticsSettings& settings)
    : hd_(library.functions()),
      session_(hd_, settings.configuration),
      description_(describe(hd_)),
      calibration_(description_.calibration_styles),
      handle_(hd_, errors_, modelNamed(description_.capabilities.model), capabilities().has_orientation,
              settings.docked_value, settings.pedal_buttons) {}

OpenHaptics::~OpenHaptics() { stop(); }

/// A guard that the device or driver lacks is no error.
void OpenHaptics::switchGuardsOn() {
  for (hd::Enum guard : {hd::kMaxForceClamping, hd::kForceRamping, hd::kSoftwareForceLimit, hd::kSoftwareVelocityLimit,
                         hd::kSoftwareForceImpulseLimit})
    hd_.enable(guard);
  HdErrors().drain(hd_);
}

void OpenHaptics::start(DeviceServo& servo, double rate_Hz) {
  assert(!started_);
  const DeviceCapabilities& can = capabilities();
  const std::string rate = std::to_string(std::lround(rate_Hz)) + " Hz";
  if (!(rate_Hz >= can.min_rate_Hz && rate_Hz <= can.max_rate_Hz))
    throw DeviceError(session_.name() + ", " + can.model + ": it is not served at " + rate + ", choose from " +
                      std::to_string(std::lround(can.min_rate_Hz)) + " to " +
                      std::to_string(std::lround(can.max_rate_Hz)) + " Hz");
  if (!HdLibrary::claimScheduler())
    throw DeviceError(session_.name() + ": another device of OpenHaptics runs already, stop that one first",
                      DeviceTrouble::busy);
  has_scheduler_ = started_ = true;
  servo_ = &servo;
  rate_Hz_ = rate_Hz;
  timing_ = CallbackTiming(rate_Hz);

  hd_.make_current_device(session_.id());
  switchGuardsOn();
  hd_.set_scheduler_rate(static_cast<unsigned long>(std::lround(rate_Hz)));
  throwOnHdError(hd_, session_.name() + ", " + can.model + ": it is not served at " + rate + ", ask for 1000 Hz");

  phase_.store(Phase::serving);
  const auto call = [](void* self) { return static_cast<OpenHaptics*>(self)->serve(); };
  schedule_ = hd_.schedule_asynchronous(call, this, hd::kFirstOfATick);
  throwOnHdError(hd_, session_.name() + ", the servo cannot be scheduled");
  hd_.start_scheduler();
  scheduler_runs_ = true;
}

void OpenHaptics::awaitLastFrame() noexcept {
  phase_.store(Phase::leaving);
  const auto until = std::chrono::steady_clock::now() + kMaxShutdown;
  while (phase_.load() != Phase::over && std::chrono::steady_clock::now() < until)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

void OpenHaptics::stop() noexcept {
  if (scheduler_runs_) {
    awaitLastFrame();
    hd_.stop_scheduler();
    // Its thread has ended, so this one may call the library.
    if (phase_.exchange(Phase::over) != Phase::over) letGo();
  }
  if (schedule_) hd_.unschedule(*schedule_);
  schedule_.reset();
  session_.close();
  if (has_scheduler_) HdLibrary::releaseScheduler();
  scheduler_runs_ = has_scheduler_ = false;
}

HandleState OpenHaptics::sense() noexcept {
  const bool calibrated = calibration_.update(hd_, rate_Hz_);
  HandleState state = handle_.read(calibrated, rate_Hz_);
  if (warm_ticks_left_ > 0) {
    --warm_ticks_left_;
    state.motor_heat = 1.0;
  }
  state.healthy = !isDead();
  return state;
}

void OpenHaptics::drive(const MotorCommand& command) noexcept {
  const glm::dvec3 force_N = command.wrench_D().force_N.xyz;
  const bool on = command.motorsOn() && std::isfinite(glm::length(force_N));
  const std::array<double, 3> served_N{on ? force_N.x : 0.0, on ? force_N.y : 0.0, on ? force_N.z : 0.0};
  if (on && !motors_on_) hd_.enable(hd::kForceOutput);
  hd_.set_doublev(hd::kCurrentForce, served_N.data());
  hd_.end_frame(session_.id());
  // The frame without force is sent first, then the motors go off.
  if (!on && motors_on_) hd_.disable(hd::kForceOutput);
  motors_on_ = on;
}

void OpenHaptics::absorbErrors() noexcept {
  const HdDrained drained = errors_.drain(hd_);
  if (drained.warm_motors) warm_ticks_left_ = static_cast<int>(kWarmFor_s * rate_Hz_);
  if (!drained.fatal || !motors_on_) return;
  hd_.disable(hd::kForceOutput);
  motors_on_ = false;
}

/// The last frame: no force, then motors off.
void OpenHaptics::letGo() noexcept {
  hd_.make_current_device(session_.id());
  hd_.begin_frame(session_.id());
  const std::array<double, 3> none{};
  hd_.set_doublev(hd::kCurrentForce, none.data());
  hd_.end_frame(session_.id());
  hd_.disable(hd::kForceOutput);
  motors_on_ = false;
  errors_.drain(hd_);
}

unsigned OpenHaptics::serve() noexcept {
  const Phase phase = phase_.load();
  if (phase == Phase::over) return hd::kCallbackContinues;
  if (phase == Phase::leaving) {
    letGo();
    phase_.store(Phase::over);
    return hd::kCallbackContinues;
  }
  hd_.make_current_device(session_.id());
  if (!begun_) servo_->begin();
  begun_ = true;

  TickTiming timing = timing_.next(monotonic_ns());
  const std::uint32_t off_requests = off_requests_.load();
  hd_.begin_frame(session_.id());
  const HandleState state = sense();
  timing.at_ns = monotonic_ns();
  const MotorCommand command = servo_->tick(state, timing);
  // A command is void if the motors were switched off since the last tick or while it was made, or the pose is invalid.
  const bool is_void =
      off_requests != off_requests_applied_ || off_requests_.load() != off_requests || !state.calibrated || isDead();
  off_requests_applied_ = off_requests;
  drive(is_void ? MotorCommand{} : command);
  absorbErrors();
  return hd::kCallbackContinues;
}

std::string OpenHaptics::trouble() const {
  if (const hd::ErrorInfo fatal = errors_.firstFatal(); fatal.code != hd::kSuccess)
    return session_.name() + ", " + errorText(fatal);
  if (phase_.load() != Phase::serving) return {};
  const std::string need = calibration_.requiredAction();
  return need.empty() ? need : session_.name() + ", " + capabilities().model + ": " + need;
}

OpenedDevice openPhantom(const std::string& rest, const DeviceOptions& options) {
  auto library = std::make_unique<HdLibrary>();
  const OpenHapticsSettings settings{.configuration = rest, .docked_value = options.docked_value};
  auto device = std::make_unique<OpenHaptics>(*library, settings);
  return {std::move(library), std::move(device), {}};
}

}  // namespace haptics
