#include "calibration/synthetic/perturbed_arm.h"

#include <cmath>

namespace calibration {
namespace {

constexpr int kSteps = 9;  ///< each reduces the error by a factor of 10 to 100

}  // namespace

Pose<Device, Handle> PerturbedArm::X_DH(const RawJoints& raw_rad) const {
  RawJoints rippled = raw_rad;
  for (std::size_t i = 0; i < rippled.size(); ++i)
    if (ripple[i].size_rad != 0.0)
      rippled[i] += ripple[i].size_rad * std::sin(raw_rad[i] * ripple[i].per_turn + ripple[i].phase_rad);
  Pose<Device, Handle> X = handlePose(geometry, truth, rippled);
  glm::dvec3 bent_mm{0.0};
  for (const Warp& one : warp)
    bent_mm += one.size_mm * std::sin(glm::dot(one.wave_per_mm, X.translation_mm) + one.phase_rad);
  X.translation_mm += bent_mm;
  return X;
}

std::optional<RawJoints> PerturbedArm::rawAt(const Pose<Device, Handle>& wanted_DH) const {
  // Fixed-point iteration on the model's inverse kinematics.
  Pose<Device, Handle> goal = wanted_DH;
  RawJoints raw{};
  for (int step = 0; step < kSteps; ++step) {
    const auto arm_rad = armAnglesFor(geometry, {goal.translation_mm});
    if (!arm_rad) return std::nullopt;
    const glm::dvec3 wrist_rad = wristAnglesFor(*arm_rad, goal.rotation);
    for (int axis = 0; axis < 3; ++axis) {
      raw[static_cast<std::size_t>(axis)] = (*arm_rad)[axis];
      raw[static_cast<std::size_t>(axis + 3)] = wrist_rad[axis];
    }
    const Pose<Device, Handle> is = X_DH(raw);
    goal.translation_mm += wanted_DH.translation_mm - is.translation_mm;
    goal.rotation = glm::normalize(wanted_DH.rotation * glm::conjugate(is.rotation) * goal.rotation);
  }
  return raw;
}

}  // namespace calibration
