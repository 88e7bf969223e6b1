#include "haptics/loop/passive_hand.h"

#include <cmath>

namespace haptics {
namespace {

/// Longer, and what is drawn would be a lie.
constexpr double kLongestDoubt_s = 0.5;

bool isBelieved(const HandleState& state) {
  const double norm = glm::dot(state.X_DH.rotation, state.X_DH.rotation);
  return state.healthy && state.calibrated && std::isfinite(norm) && std::abs(norm - 1.0) < 1e-6 &&
         std::isfinite(glm::length(state.X_DH.translation_mm));
}

}  // namespace

PassiveHand::PassiveHand(ServedDevice served, double rate_Hz) : DeviceLoop(served, rate_Hz, std::nullopt) {
  forbidForce();
}

std::optional<HandleState> PassiveHand::newest() {
  // A device that hangs brings nothing at all.
  const std::int64_t now = now_ns();
  if (const std::uint64_t ticks = this->ticks(); ticks != ticks_read_) {
    ticks_read_ = ticks;
    last_tick_ns_ = now;
  }
  const Seen& seen = newest_.read();
  const bool hangs = 1e-9 * static_cast<double>(now - last_tick_ns_) > kLongestDoubt_s;
  if (!seen.any || hangs || seen.doubted_s > kLongestDoubt_s) return std::nullopt;
  return seen.state;
}

DeviceLoop::Answer PassiveHand::answer(const HandleState& state, const Beat& beat) noexcept {
  if (isBelieved(state)) {
    seen_ = {state, true, 0.0};
  } else {
    if (seen_.doubted_s == 0.0) troubles_.fetch_add(1, std::memory_order_relaxed);
    seen_.doubted_s += static_cast<double>(1 + beat.missed) / rate_Hz();
  }
  newest_.publish(seen_);
  return {{}, false};
}

}  // namespace haptics
