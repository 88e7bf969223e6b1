#include "app/device/check/constant_force_loop.h"

#include <thread>

#include "haptics/device/thread_priority.h"
#include "haptics/servo/haptic_loop.h"

namespace app {
namespace {

constexpr double kMean_s = 0.25;

/// Frame P is D here: there is no patient.
haptics::HandSample sampleOf(const haptics::HandleState& state) {
  haptics::HandSample hand;
  hand.X_PT = {state.X_DH.rotation, state.X_DH.translation_mm};
  hand.velocity_P_mm_per_s = hand.handle_velocity_P_mm_per_s = {state.velocity_D_mm_per_s.xyz};
  hand.jacobian_P_mm = state.jacobian_D_mm;
  hand.motor_heat = state.motor_heat;
  hand.fresh = state.fresh;
  hand.docked = state.docked;
  hand.held = state.held;
  hand.calibrated = state.calibrated;
  hand.device_healthy = state.healthy;
  return hand;
}

}  // namespace

ConstantForceLoop::ConstantForceLoop(haptics::ServedDevice served, double rate_Hz)
    : DeviceLoop(served, rate_Hz, haptics::kServoPriority),
      is_stepped_(served.stepped != nullptr),
      limits_(haptics::limitedTo(served.device.capabilities(), rate_Hz, haptics::Command{}).safety) {}

void ConstantForceLoop::wait(std::chrono::milliseconds time) {
  if (is_stepped_)
    step(static_cast<std::uint64_t>(rate_Hz() * std::chrono::duration<double>(time).count()));
  else
    std::this_thread::sleep_for(time);
}

ConstantForceLoop::Answer ConstantForceLoop::answer(const haptics::HandleState& state,
                                                    const haptics::TickTiming& timing) noexcept {
  const double dt_s = 1.0 / rate_Hz();
  haptics::HandSample sample = sampleOf(state);
  sample.stop_requested = isForceDisabled();
  sample.gap_s = timing.gap_s;
  const haptics::SafetyLayer::Admitted admitted =
      safety_.admit(sample, limits_, rearm_.load(std::memory_order_relaxed), dt_s);

  haptics::SafetyLayer::Request wanted;
  wanted.vibration_P_N = {requested_D_N_.read()};
  const glm::dvec3 position_mm = admitted.hand.X_PT.translation_mm;
  if (has_last_ && !admitted.relocated) wanted.motion.travel_P_mm = {position_mm - last_mm_};
  last_mm_ = position_mm;
  has_last_ = true;
  const haptics::SafetyFilter::Delivered served = safety_.serve(wanted, limits_, dt_s);

  seen_.state = state;
  seen_.safety = admitted.state;
  seen_.pushed_D_N = served.wrench_P.force_N.xyz;
  seen_.lately_D_N += dt_s / (kMean_s + dt_s) * (seen_.pushed_D_N - seen_.lately_D_N);
  seen_.tripped |= static_cast<std::uint32_t>(admitted.faults | served.faults);
  ++seen_.ticks;
  newest_.publish(seen_);
  return {{{seen_.pushed_D_N}, {}}, haptics::mayRunMotors(seen_.safety)};
}

}  // namespace app
