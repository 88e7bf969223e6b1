#include "app/rehearsal/pace.h"

#include <algorithm>
#include <cmath>

namespace app {
namespace {

constexpr double kSteppedFrames_per_s = 60.0;

}  // namespace

Pace::Time Pace::now() const {
  if (isRealTime()) return std::chrono::steady_clock::now();
  return Time(std::chrono::duration_cast<Time::duration>(
      std::chrono::duration<double>(static_cast<double>(ticks_) / equipment_.rate_Hz())));
}

void Pace::toNextFrame() {
  if (isRealTime()) return view_.waitUntilShown();
  const double rate_Hz = equipment_.rate_Hz();
  std::uint64_t until = ticks_ + static_cast<std::uint64_t>(rate_Hz / kSteppedFrames_per_s);
  if (const auto requested = script_.nextTick()) until = std::min(until, *requested);
  // The sum of the ticks' dt is rounded.
  if (duration_s_) until = std::min(until, static_cast<std::uint64_t>(std::ceil(*duration_s_ * rate_Hz - 1e-6)));
  until = std::max(until, ticks_ + 1);
  equipment_.workstation().step(until - ticks_);
  ticks_ = until;
  if (SecondHand* const second_hand = equipment_.secondHand())
    second_hand->stepTo(static_cast<double>(ticks_) / rate_Hz);
}

}  // namespace app
