#include "app/debrief/transport.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

namespace app {
namespace {

constexpr double kAtMark_s = 0.05;  ///< as near is at it: the one after or before is meant

}  // namespace

void Transport::setLength(double length_s) {
  length_s_ = length_s;
  goTo(position_s_);
}

double Transport::speed() const { return kSpeeds[static_cast<std::size_t>(speed_)]; }

void Transport::advance(double wall_s) {
  if (!isPlaying()) return;
  goTo(position_s_ + direction_ * speed() * wall_s);
  if (direction_ > 0 ? position_s_ >= length_s_ : position_s_ <= 0.0) pause();
}

void Transport::playOrPause() {
  if (isPlaying()) return pause();
  if (position_s_ >= length_s_) position_s_ = 0.0;
  direction_ = 1;
}

void Transport::shuttle(int direction) {
  if (direction == direction_)
    changeSpeed(1);
  else
    speed_ = kNormal;
  direction_ = direction;
}

void Transport::changeSpeed(int steps) { speed_ = std::clamp(speed_ + steps, 0, static_cast<int>(kSpeeds.size()) - 1); }

void Transport::setSpeed(double speed) {
  if (!(speed > 0.0)) return;
  const auto farness = [speed](double of) { return std::abs(std::log2(of / speed)); };
  speed_ = static_cast<int>(std::ranges::min_element(kSpeeds, {}, farness) - kSpeeds.begin());
}

void Transport::goTo(double t_s) {
  if (std::isfinite(t_s)) position_s_ = std::clamp(t_s, 0.0, length_s_);
}

void Transport::goToNext(std::span<const double> times_s, int direction) {
  const auto after = std::ranges::upper_bound(times_s, position_s_ + kAtMark_s);
  const auto from = std::ranges::lower_bound(times_s, position_s_ - kAtMark_s);
  if (direction > 0 && after != times_s.end()) goTo(*after);
  if (direction < 0 && from != times_s.begin()) goTo(*std::prev(from));
}

std::string Transport::speedText() const {
  const double now = speed();
  return now < 1.0 ? fmt::format("1/{:.0f} ×", 1.0 / now) : fmt::format("{:.0f} ×", now);
}

}  // namespace app
