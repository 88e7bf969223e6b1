#include "app/procedure/root_canal/file_motion.h"

#include <cmath>
#include <numbers>

namespace app {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kReversed_rad = 6.0 * kDegree;    ///< a turn has ended that goes back so far
constexpr double kTurned_rad = 10.0 * kDegree;     ///< in a window: less is no turning
constexpr double kSlid_mm = 0.2;                   ///< in a window: less is no filing
constexpr double kQuarter_rad = 80.0 * kDegree;    ///< from here on a turn is no winding
constexpr double kBalanced_rad = 125.0 * kDegree;  ///< counter-clockwise; the widest winding is 60 to either side
constexpr double kAlike_rad = 15.0 * kDegree;
constexpr double kOnTheWay = 1e-9;

}  // namespace

std::string_view nameOf(FileMotion motion) {
  constexpr std::array<std::string_view, kFileMotions> kNames{"filing", "reaming", "watch-winding", "balanced force"};
  return kNames[static_cast<std::size_t>(motion)];
}

std::string_view keyOf(FileMotion motion) {
  constexpr std::array<std::string_view, kFileMotions> kKeys{"filing", "reaming", "watch_winding", "balanced_force"};
  return kKeys[static_cast<std::size_t>(motion)];
}

void MotionNames::settle(std::optional<FileMotion> motion) {
  if (motion)
    seconds_[static_cast<std::size_t>(*motion)] += waiting_s_;
  else
    other_s_ += waiting_s_;
  waiting_s_ = 0.0;
  now_ = motion;
}

void MotionNames::endTurn(bool goes_back) {
  const double way_rad = far_roll_rad_ - from_roll_rad_, turn_rad = std::fabs(way_rad) < kReversed_rad ? 0.0 : way_rad;
  from_roll_rad_ = far_roll_rad_;
  if (turn_rad > 0.0) cw_rad_ = turn_rad;
  // What a clockwise turn was is told by what follows.
  if (turn_rad >= 0.0 && (goes_back || cw_rad_ == 0.0)) return;
  // The last of a winding is no larger than the one before.
  const bool still_winds = now_ == FileMotion::watch_winding && cw_rad_ < ccw_rad_ + kAlike_rad;
  if (turn_rad < 0.0) {
    ccw_rad_ = -turn_rad;
    settle(ccw_rad_ >= kBalanced_rad ? FileMotion::balanced_force : FileMotion::watch_winding);
  } else {
    settle(cw_rad_ >= kQuarter_rad && !still_winds ? FileMotion::reaming : FileMotion::watch_winding);
  }
  cw_rad_ = 0.0;
  after_ream_ = now_ == FileMotion::reaming;
}

void MotionNames::endWindow() {
  const bool turns = turned_rad_ >= kTurned_rad, slides = slid_mm_ >= kSlid_mm;
  if (!turns) endTurn(false);
  if (turns) {
    waiting_s_ += window_s_;
    after_ream_ = false;
  } else {
    // Turns end by stopping, so nothing waits but what never had a name.
    if (waiting_s_ > 0.0) settle(std::nullopt);
    const bool reams = after_ream_ && slides && gone_mm_ < -0.5 * slid_mm_;
    waiting_s_ = window_s_;
    settle(!slides ? std::nullopt : std::optional(reams ? FileMotion::reaming : FileMotion::filing));
    after_ream_ = reams;
  }
  window_s_ = turned_rad_ = slid_mm_ = gone_mm_ = 0.0;
}

void MotionNames::add(double dt_s, double roll_rad, double in_mm) {
  if (!has_last_) {
    has_last_ = true;
    last_roll_rad_ = from_roll_rad_ = far_roll_rad_ = roll_rad;
    last_in_mm_ = in_mm;
  }
  const double turned_rad = roll_rad - last_roll_rad_, slid_mm = in_mm - last_in_mm_;
  last_roll_rad_ = roll_rad, last_in_mm_ = in_mm;
  turned_rad_ += std::fabs(turned_rad);
  slid_mm_ += std::fabs(slid_mm);
  gone_mm_ += slid_mm;
  window_s_ += dt_s;

  // On in the same direction, or back from the farthest.
  const double way_rad = far_roll_rad_ - from_roll_rad_;
  if (way_rad * (roll_rad - far_roll_rad_) > 0.0 || (way_rad == 0.0 && turned_rad != 0.0))
    far_roll_rad_ = roll_rad;
  else if (std::fabs(roll_rad - far_roll_rad_) > kReversed_rad) {
    endTurn(true);
    far_roll_rad_ = roll_rad;
  }
  if (window_s_ >= kMotionWindow_s - kOnTheWay) endWindow();
}

void MotionNames::lift() {
  if (has_last_) {
    waiting_s_ += window_s_;
    endTurn(false);
    settle(std::nullopt);
  }
  after_ream_ = has_last_ = false;
  window_s_ = turned_rad_ = slid_mm_ = gone_mm_ = 0.0;
}

}  // namespace app
