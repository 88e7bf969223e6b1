#include "app/rehearsal/fast_pace.h"

#include <algorithm>
#include <cmath>

namespace app {
namespace {

constexpr double kFrames_per_s = 60.0;

}  // namespace

Pace::Time FastPace::now() const {
  return Time(std::chrono::duration_cast<Time::duration>(
      std::chrono::duration<double>(static_cast<double>(ticks_) / rate_Hz_)));
}

void FastPace::toNextFrame() {
  std::uint64_t until = ticks_ + std::max<std::uint64_t>(1, static_cast<std::uint64_t>(rate_Hz_ / kFrames_per_s));
  if (const auto requested = script_.nextTick()) until = std::min(until, *requested);
  // The sum of the ticks' dt is a rounded number.
  if (duration_s_) until = std::min(until, static_cast<std::uint64_t>(std::ceil(*duration_s_ * rate_Hz_ - 1e-6)));
  until = std::max(until, ticks_ + 1);
  workstation_.step(until - ticks_);
  ticks_ = until;
  if (second_hand_ != nullptr) second_hand_->stepTo(static_cast<double>(ticks_) / rate_Hz_);
}

}  // namespace app
