// The sensors of a Phantom: encoders at the arm's joints, potentiometers in the gimbal, and the velocity that a driver
// derives from them, differenced and low-passed. An untrue arm (wrong lengths and zeros) reads its own angles, which
// the driver evaluates with the nominal model. Frame D, mm, rad, s. The device's thread; no allocation. The same seed
// gives the same noise.
#pragma once

#include <cstdint>
#include <optional>
#include <random>

#include "calibration/synthetic/perturbed_arm.h"

namespace haptics {

/// 0 in any of them: ideal.
struct PhantomSensing {
  double counts_per_turn = 0.0;     ///< of each arm encoder, at the joint
  double levels_per_turn = 0.0;     ///< of each potentiometer, with noise one level wide
  double velocity_cutoff_Hz = 0.0;  ///< of the first-order low-pass; ideal: the true velocity
};

class PhantomSensors {
 public:
  struct Reading {
    calibration::Pose<calibration::Device, calibration::Handle> X_DH;
    calibration::Vector<calibration::Device> velocity_D_mm_per_s;
    glm::dmat3 jacobian_D_mm{0.0};
    calibration::RawJoints joints_rad{};
  };

  PhantomSensors(const calibration::PhantomGeometry& geometry, const PhantomSensing& sensing, std::uint32_t seed,
                 const std::optional<calibration::PerturbedArm>& untrue = std::nullopt)
      : geometry_(geometry), sensing_(sensing), untrue_(untrue), noise_(seed) {}

  /// `truth`: the angles at which the nominal arm would hold the handle at its true pose.
  Reading read(const calibration::PhantomJoints& truth, const glm::dvec3& true_velocity_mm_per_s, double dt_s) noexcept;

 private:
  calibration::PhantomJoints sensed(const calibration::PhantomJoints& truth) noexcept;
  double readPotentiometer(double angle_rad) noexcept;

  calibration::PhantomGeometry geometry_;
  PhantomSensing sensing_;
  std::optional<calibration::PerturbedArm> untrue_;
  calibration::PhantomJoints last_sensed_;
  std::mt19937 noise_;
  glm::dvec3 last_mm_{0.0}, velocity_mm_per_s_{0.0};
  bool has_last_ = false;
};

}  // namespace haptics
