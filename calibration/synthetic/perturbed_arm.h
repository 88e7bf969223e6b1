// A realistic arm: its sensors and lengths differ from the model, partly in ways that the correction cannot express.
// The ground truth of a simulated calibration. Frames as phantom_kinematics; mm, rad. Pure; any thread, the simulated
// device's too: no allocation; tip and pose about 1 us, raw joints about 15 us. Sizes and forms of the errors:
// reference/calibration 3.1.
#pragma once

#include <array>
#include <optional>

#include "calibration/arm/arm_correction.h"

namespace calibration {

/// angle += size sin(per_turn raw + phase)
struct Ripple {
  double size_rad = 0.0, per_turn = 1.0, phase_rad = 0.0;
};
/// position += size sin(wave · position + phase): bending of frame and links.
struct Warp {
  glm::dvec3 size_mm{0.0}, wave_per_mm{0.0};
  double phase_rad = 0.0;
};

struct PerturbedArm {
  PhantomGeometry geometry;        ///< the driver's model
  ArmCorrection truth;             ///< the result of a perfect calibration
  std::array<Ripple, 6> ripple{};  ///< encoder cyclic errors, harmonics of the gimbal's potentiometers
  std::array<Warp, 6> warp{};

  /// The true handle pose for these sensor readings.
  Pose<Device, Handle> X_DH(const RawJoints& raw_rad) const;
  Point<Device> tip_D(const RawJoints& raw_rad) const { return X_DH(raw_rad) * Point<Handle>{truth.tip_H_mm}; }
  /// Sensor readings for a true handle pose, before quantisation; none: outside the arm's limits. To 1e-6 mm.
  std::optional<RawJoints> rawAt(const Pose<Device, Handle>& X_DH) const;
};

}  // namespace calibration
