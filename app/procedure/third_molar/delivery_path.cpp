#include "app/procedure/third_molar/delivery_path.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "calibration/geometry/units.h"

namespace app {
namespace {

constexpr double kOver_mm = 16.0;                                  ///< the piece, before it is gripped
constexpr double kTravel_mm_per_s = 100.0, kTurn_rad_per_s = 2.5;  ///< free of the mouth
constexpr double kDown_mm_per_s = 15.0, kOut_mm_per_s = 12.0, kCarried_mm_per_s = 100.0;
constexpr double kSwing_Hz = 0.8, kFirstSwing_rad = 0.2, kLastSwing_rad = 0.45, kPull_mm = 1.5;
constexpr double kTwist_rad = 1.0, kTwist_Hz = 0.5, kTwists = 2.0;
constexpr double kBeyond_mm = 10.0;  ///< the end of the way out
constexpr double kStill_s = 0.3;

}  // namespace

haptics::LedPath throughOutside(const HandPose& from, const HandPose& to, const glm::dvec3& outside_P_mm) {
  LedKeys keys(from);
  keys.moveTo({from.rotation, outside_P_mm}, kTravel_mm_per_s);
  keys.moveTo({to.rotation, outside_P_mm}, kTravel_mm_per_s, kTurn_rad_per_s);
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
  LedKeys down(over);
  down.moveTo(in_slot, kDown_mm_per_s);
  down.hold(kStill_s);
  const auto twisted = [=](double t_s) {
    const double twist_rad = kTwist_rad * std::sin(2.0 * calibration::kPi * kTwist_Hz * t_s);
    return targetAt({R_PT * glm::angleAxis(twist_rad, glm::dvec3(0.0, 0.0, 1.0)), step.tip_P_mm}, false);
  };
  LedKeys up(in_slot);
  up.moveTo(over, kTravel_mm_per_s);
  return joined(joined(throughOutside(from, over, outside_P_mm), down.path()),
                joined({twisted, kTwists / kTwist_Hz}, up.path()));
}

haptics::LedPath gripAndRock(const HandPose& from, const glm::dvec3& outside_P_mm, const DeliveryStep& step,
                             const glm::dquat& R_PT) {
  const HandPose grip{R_PT, step.grip_P_mm}, over{R_PT, step.grip_P_mm + kOver_mm * step.out_P};
  LedKeys down(over);
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

haptics::LedPath takeOut(const HandPose& hand, const haptics::PiecePose& piece_X_PQ, const DeliveryStep& step,
                         const glm::dvec3& outside_P_mm, const glm::dvec3& laid_P_mm) {
  LedKeys keys(hand);
  keys.press(true);
  const calibration::Pose<calibration::Piece, calibration::Tool> grip_X_QT = piece_X_PQ.inverse() * hand;
  HandPose last = hand;
  for (const haptics::PiecePose& X_PQ : step.path_X_PQ) {
    last = X_PQ * grip_X_QT;
    keys.moveTo(last, kOut_mm_per_s);
  }
  last.translation_mm += kBeyond_mm * step.out_P;
  keys.moveTo(last, 2.0 * kOut_mm_per_s);
  keys.moveTo({last.rotation, outside_P_mm}, kCarried_mm_per_s);
  keys.moveTo({last.rotation, laid_P_mm}, kCarried_mm_per_s);
  keys.hold(kStill_s);
  keys.press(false);
  keys.hold(kStill_s);
  return keys.path();
}

}  // namespace app
