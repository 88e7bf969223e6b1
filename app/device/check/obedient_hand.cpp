#include "app/device/check/obedient_hand.h"

namespace app {
namespace {

constexpr double kSpeed_mm_per_s = 250.0;
constexpr double kOfTheBox = 0.35;  ///< corners, from the middle: within every arm's reach

}  // namespace

ObedientHand::ObedientHand(const haptics::PhantomMechanics& phantom) {
  const auto X_DH = phantom.rest_DH();
  rest_mm_ = X_DH.translation_mm;
  rotation_ = X_DH.rotation;
  middle_mm_ = 0.5 * (phantom.workspace.least_D_mm + phantom.workspace.most_D_mm);
  corner_mm_ = kOfTheBox * (phantom.workspace.most_D_mm - phantom.workspace.least_D_mm);
}

glm::dvec3 ObedientHand::goal_mm(HandTask task) const {
  if (task == HandTask::rest) return rest_mm_;
  if (task == HandTask::upper_corner) return middle_mm_ + corner_mm_;
  return task == HandTask::lower_corner ? middle_mm_ - corner_mm_ : middle_mm_;
}

haptics::HandScript ObedientHand::script() {
  return [this, place_mm = rest_mm_, last_s = 0.0](double t_s) mutable {
    const HandTask task = task_.load(std::memory_order_relaxed);
    const glm::dvec3 way_mm = goal_mm(task) - place_mm;
    const double reach_mm = kSpeed_mm_per_s * (t_s - last_s), length_mm = glm::length(way_mm);
    if (t_s > last_s) {
      place_mm += length_mm > reach_mm ? way_mm * (reach_mm / length_mm) : way_mm;
      last_s = t_s;
    }
    haptics::HandTarget target{place_mm, rotation_};
    target.grips = task != HandTask::let_go;
    target.buttons = task == HandTask::first_button ? 1u : task == HandTask::second_button ? 2u : 0u;
    return target;
  };
}

}  // namespace app
