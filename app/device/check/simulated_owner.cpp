#include "app/device/check/simulated_owner.h"

namespace app {
namespace {

constexpr double kSpeed_mm_per_s = 250.0;
constexpr double kOfTheBox = 0.35;  ///< corners, from the middle: within every arm's reach

}  // namespace

SimulatedOwner::SimulatedOwner(const haptics::PhantomMechanics& phantom) {
  const auto X_DH = phantom.rest_DH();
  rest_mm_ = X_DH.translation_mm;
  rotation_ = X_DH.rotation;
  middle_mm_ = 0.5 * (phantom.workspace.min_D_mm + phantom.workspace.max_D_mm);
  corner_mm_ = kOfTheBox * (phantom.workspace.max_D_mm - phantom.workspace.min_D_mm);
}

glm::dvec3 SimulatedOwner::goal_mm(OwnerTask task) const {
  if (task == OwnerTask::rest) return rest_mm_;
  if (task == OwnerTask::upper_corner) return middle_mm_ + corner_mm_;
  return task == OwnerTask::lower_corner ? middle_mm_ - corner_mm_ : middle_mm_;
}

haptics::HandScript SimulatedOwner::script() {
  return [this, position_mm = rest_mm_, last_s = 0.0](double t_s) mutable {
    const OwnerTask task = task_.load(std::memory_order_relaxed);
    const glm::dvec3 way_mm = goal_mm(task) - position_mm;
    const double reach_mm = kSpeed_mm_per_s * (t_s - last_s), length_mm = glm::length(way_mm);
    if (t_s > last_s) {
      position_mm += length_mm > reach_mm ? way_mm * (reach_mm / length_mm) : way_mm;
      last_s = t_s;
    }
    haptics::HandTarget target{position_mm, rotation_};
    target.grips = task != OwnerTask::let_go;
    target.buttons = task == OwnerTask::first_button ? 1u : task == OwnerTask::second_button ? 2u : 0u;
    return target;
  };
}

}  // namespace app
