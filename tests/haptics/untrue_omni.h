// An Omni with seeded errors of typical size, all of them such that a correction can express them.
#pragma once

#include <random>

#include "calibration/arm/phantom_models.h"
#include "calibration/geometry/units.h"
#include "calibration/synthetic/perturbed_arm.h"

namespace haptics {

inline calibration::PerturbedArm untrueOmni(std::uint32_t seed) {
  std::mt19937 rng(seed);
  const auto about = [&](double sigma) { return std::normal_distribution<double>(0.0, sigma)(rng); };
  calibration::PerturbedArm arm;
  arm.geometry = calibration::kOmniGeometry;
  for (std::size_t i = 0; i < 6; ++i) {
    arm.truth.offset_rad[i] = about(calibration::radFromDegrees(i < 3 ? 0.5 : 1.0));
    arm.truth.gain[i] = about(i < 3 ? 0.004 : 0.01);
  }
  for (double& quadratic : arm.truth.quadratic_per_rad) quadratic = about(0.002);
  arm.truth.thigh_delta_mm = about(0.3), arm.truth.shin_delta_mm = about(0.3);
  arm.truth.tilt_rad = about(0.002), arm.truth.reach_delta_mm = about(0.3);
  arm.truth.tip_H_mm += glm::dvec3(about(0.5), about(0.5), about(0.5));
  return arm;
}

/// Somewhere in the middle of its room, held as a pen is.
inline calibration::Pose<calibration::Device, calibration::Handle> heldSomewhere(std::mt19937& rng) {
  const auto within = [&](double most) { return std::uniform_real_distribution<double>(-most, most)(rng); };
  return {glm::normalize(glm::angleAxis(within(0.5), glm::dvec3(1, 0, 0)) *
                         glm::angleAxis(within(0.5), glm::dvec3(0, 1, 0)) *
                         glm::angleAxis(within(0.5), glm::dvec3(0, 0, 1))),
          {within(70.0), within(50.0), within(35.0)}};
}

}  // namespace haptics
