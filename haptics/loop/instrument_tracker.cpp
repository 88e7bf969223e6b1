#include "haptics/loop/instrument_tracker.h"

#include <cmath>

namespace haptics {
namespace {

constexpr double kMaxInvalid_s = 0.5;

bool isValid(const HandleState& state) {
  const double norm = glm::dot(state.X_DH.rotation, state.X_DH.rotation);
  return state.healthy && state.calibrated && std::isfinite(norm) && std::abs(norm - 1.0) < 1e-6 &&
         std::isfinite(glm::length(state.X_DH.translation_mm));
}

}  // namespace

InstrumentTracker::InstrumentTracker(ServedDevice served, double rate_Hz)
    : DeviceLoop(served, rate_Hz, std::nullopt), watchdog_(static_cast<std::int64_t>(1e9 * kMaxInvalid_s)) {
  disableForce();
}

std::optional<HandleState> InstrumentTracker::newest() {
  const bool hangs = watchdog_.hasExpired(ticks(), now_ns());
  const Seen& seen = newest_.read();
  if (!seen.any || hangs || seen.invalid_s > kMaxInvalid_s) return std::nullopt;
  return seen.state;
}

DeviceLoop::Answer InstrumentTracker::answer(const HandleState& state, const TickTiming& timing) noexcept {
  if (isValid(state)) {
    seen_ = {state, true, 0.0};
  } else {
    if (seen_.invalid_s == 0.0) dropouts_.fetch_add(1, std::memory_order_relaxed);
    seen_.invalid_s += static_cast<double>(1 + timing.missed) / rate_Hz();
  }
  newest_.publish(seen_);
  return {{}, false};
}

}  // namespace haptics
