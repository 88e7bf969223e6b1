// An arm as real ones are: none of its sensors and lengths quite what its model says, and partly in ways that no
// correction can express. The truth that a calibration has to find. Frames as phantom_kinematics; mm, rad. Pure; any
// thread, the simulated device's too: no allocation; tip and pose about 1 us, raw joints about 15 us.
// Sizes and forms of the errors: reference/calibration 3.1.
#pragma once

#include <array>
#include <optional>

#include "calibration/arm/arm_correction.h"

namespace calibration {

/// angle += size sin(per_turn raw + phase)
struct Ripple {
  double size_rad = 0.0, per_turn = 1.0, phase_rad = 0.0;
};
/// place += size sin(wave · place + phase): how frame and links bend.
struct Warp {
  glm::dvec3 size_mm{0.0}, wave_per_mm{0.0};
  double phase_rad = 0.0;
};

struct PerturbedArm {
  PhantomGeometry geometry;        ///< the model that the device's driver believes in
  ArmCorrection truth;             ///< what a perfect calibration would find
  std::array<Ripple, 6> ripple{};  ///< cyclic errors of encoders, harmonics of the gimbal's potentiometers
  std::array<Warp, 6> warp{};

  /// Where the handle truly is while the sensors read this.
  Pose<Device, Handle> X_DH(const RawJoints& raw_rad) const;
  Point<Device> tip_D(const RawJoints& raw_rad) const { return X_DH(raw_rad) * Point<Handle>{truth.tip_H_mm}; }
  /// What the sensors read while the handle is truly there, before they round; none beyond the arm's limits. A fixed
  /// number of steps from the model's own inverse; to 1e-6 mm.
  std::optional<RawJoints> rawAt(const Pose<Device, Handle>& X_DH) const;
};

}  // namespace calibration
