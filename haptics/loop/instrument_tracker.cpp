#include "haptics/loop/instrument_tracker.h"

#include <cmath>

namespace haptics {
namespace {

/// Longer, and what is drawn would be a lie.
constexpr double kMaxInvalid_s = 0.5;

bool isValid(const HandleState& state) {
  const double norm = glm::dot(state.X_DH.rotation, state.X_DH.rotation);
  return state.healthy && state.calibrated && std::isfinite(norm) && std::abs(norm - 1.0) < 1e-6 &&
         std::isfinite(glm::length(state.X_DH.translation_mm));
}

}  // namespace

InstrumentTracker::InstrumentTracker(ServedDevice served, double rate_Hz) : DeviceLoop(served, rate_Hz, std::nullopt) {
  disableForce();
}

std::optional<HandleState> InstrumentTracker::newest() {
  // A device that hangs brings nothing at all.
  const std::int64_t now = now_ns();
  if (const std::uint64_t ticks = this->ticks(); ticks != ticks_read_) {
    ticks_read_ = ticks;
    last_tick_ns_ = now;
  }
  const Seen& seen = newest_.read();
  const bool hangs = 1e-9 * static_cast<double>(now - last_tick_ns_) > kMaxInvalid_s;
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
