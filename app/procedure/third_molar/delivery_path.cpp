#include "app/procedure/third_molar/delivery_path.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "calibration/geometry/units.h"

namespace app {
namespace {

constexpr double kOver_mm = 16.0;  ///< the piece, before it is gripped
constexpr double kTravel_mm_per_s = 60.0, kDown_mm_per_s = 15.0, kOut_mm_per_s = 12.0, kTurn_rad_per_s = 0.8;
constexpr double kSwing_Hz = 0.8, kFirstSwing_rad = 0.2, kLastSwing_rad = 0.45, kPull_mm = 1.5;
constexpr double kTwist_rad = 1.0, kTwist_Hz = 0.5, kTwists = 2.0;
constexpr double kBeyond_mm = 10.0;  ///< the end of the way out
constexpr double kStill_s = 0.3;

struct Key {
  double t_s = 0.0;
  HandPose X_PT;
  bool pedal = false;  ///< down until the next key
};

haptics::HandTarget targetAt(const HandPose& X_PT, bool pedal) {
  return {X_PT.translation_mm, X_PT.rotation, pedal, 0, true};
}

/// Straight from key to key.
haptics::LedPath along(std::vector<Key> keys) {
  const double end_s = keys.back().t_s;
  return {[keys = std::move(keys)](double t_s) {
            auto next = std::ranges::find_if(keys, [&](const Key& key) { return key.t_s > t_s; });
            if (next == keys.begin()) return targetAt(next->X_PT, next->pedal);
            if (next == keys.end()) return targetAt(keys.back().X_PT, keys.back().pedal);
            const Key& from = *(next - 1);
            const double part = (t_s - from.t_s) / (next->t_s - from.t_s);
            return targetAt({glm::slerp(from.X_PT.rotation, next->X_PT.rotation, part),
                             glm::mix(from.X_PT.translation_mm, next->X_PT.translation_mm, part)},
                            from.pedal);
          },
          end_s};
}

/// Keys of a hand that moves on.
class Keys {
 public:
  explicit Keys(const HandPose& from) : keys_{{0.0, from, false}} {}

  void press(bool pedal) { keys_.back().pedal = pedal; }
  void moveTo(const HandPose& X_PT, double mm_per_s) {
    const Key& last = keys_.back();
    const double turn_rad = 2.0 * std::acos(std::min(1.0, std::abs(glm::dot(last.X_PT.rotation, X_PT.rotation))));
    const double takes_s = std::max(
        {glm::distance(last.X_PT.translation_mm, X_PT.translation_mm) / mm_per_s, turn_rad / kTurn_rad_per_s, 0.01});
    keys_.push_back({last.t_s + takes_s, X_PT, last.pedal});
  }
  void hold(double seconds) { keys_.push_back({keys_.back().t_s + seconds, keys_.back().X_PT, keys_.back().pedal}); }
  haptics::LedPath path() { return along(std::move(keys_)); }

 private:
  std::vector<Key> keys_;
};

}  // namespace

haptics::LedPath throughOutside(const HandPose& from, const HandPose& to, const glm::dvec3& outside_P_mm) {
  Keys keys(from);
  keys.moveTo({from.rotation, outside_P_mm}, kTravel_mm_per_s);
  keys.moveTo({to.rotation, outside_P_mm}, kTravel_mm_per_s);
  keys.moveTo(to, kTravel_mm_per_s);
  return keys.path();
}

haptics::LedPath joined(const haptics::LedPath& first, const haptics::LedPath& second) {
  const double from_s = first.duration_s;
  return {[first = first.script, second = second.script, from_s](double t_s) {
            return t_s < from_s ? first(t_s) : second(t_s - from_s);
          },
          from_s + second.duration_s};
}

haptics::LedPath twistInSlot(const HandPose& from, const glm::dvec3& outside_P_mm, const SplitStep& step) {
  const glm::dquat R_PT = glm::quat_cast(glm::dmat3(step.along_P, glm::cross(step.out_P, step.along_P), step.out_P));
  const HandPose in_slot{R_PT, step.tip_P_mm}, over{R_PT, step.tip_P_mm + kOver_mm * step.out_P};
  Keys down(over);
  down.moveTo(in_slot, kDown_mm_per_s);
  down.hold(kStill_s);
  const auto twisted = [=](double t_s) {
    const double twist_rad = kTwist_rad * std::sin(2.0 * calibration::kPi * kTwist_Hz * t_s);
    return targetAt({R_PT * glm::angleAxis(twist_rad, glm::dvec3(0.0, 0.0, 1.0)), step.tip_P_mm}, false);
  };
  Keys up(in_slot);
  up.moveTo(over, kTravel_mm_per_s);
  return joined(joined(throughOutside(from, over, outside_P_mm), down.path()),
                joined({twisted, kTwists / kTwist_Hz}, up.path()));
}

haptics::LedPath gripAndRock(const HandPose& from, const glm::dvec3& outside_P_mm, const DeliveryStep& step,
                             const glm::dquat& R_PT) {
  const HandPose grip{R_PT, step.grip_P_mm}, over{R_PT, step.grip_P_mm + kOver_mm * step.out_P};
  Keys down(over);
  down.moveTo(grip, kDown_mm_per_s);
  down.hold(kStill_s);
  down.press(true);
  down.hold(kStill_s);
  const auto rocked = [=](double t_s) {
    const double part = std::clamp(t_s / kRocks_s, 0.0, 1.0);
    const double swing_rad =
        glm::mix(kFirstSwing_rad, kLastSwing_rad, part) * std::sin(2.0 * calibration::kPi * kSwing_Hz * t_s);
    const glm::dvec3 pulled_mm = std::min(1.0, t_s) * kPull_mm * step.out_P;
    return targetAt({glm::angleAxis(swing_rad, step.rock_axis_P) * R_PT, step.grip_P_mm + pulled_mm}, true);
  };
  return joined(throughOutside(from, over, outside_P_mm), joined(down.path(), {rocked, kRocks_s}));
}

haptics::LedPath takeOut(const HandPose& hand, const haptics::PiecePose& piece_X_PQ, const DeliveryStep& step) {
  Keys keys(hand);
  keys.press(true);
  const calibration::Pose<calibration::Piece, calibration::Tool> grip_X_QT = piece_X_PQ.inverse() * hand;
  HandPose last = hand;
  for (const haptics::PiecePose& X_PQ : step.path_X_PQ) {
    last = X_PQ * grip_X_QT;
    keys.moveTo(last, kOut_mm_per_s);
  }
  last.translation_mm += kBeyond_mm * step.out_P;
  keys.moveTo(last, 2.0 * kOut_mm_per_s);
  keys.hold(2.0 * kStill_s);
  keys.press(false);
  keys.hold(2.0 * kStill_s);
  return keys.path();
}

}  // namespace app
