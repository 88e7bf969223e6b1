// Cutting: what a turning spherical bur takes from the bone in one step. mm³ per second, whatever the voxel size, the
// tick rate and the order of the voxels. Frame P, mm, s. Servo thread (or any one thread that owns the bone).
// A voxel covered by the fraction g loses g * rate * factor * dt of what it held at first, until its dose reaches the
// largest g it has seen: linear in dose, and never more than the swept volume however long the bur stays.
// Cost: some 10 ns per solid voxel touched. Not the force (contact).
#pragma once

#include <array>
#include <cstdint>

#include "assets/tissue.h"
#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "haptics/bone/carved_bone.h"
#include "haptics/bone/erosion.h"

namespace haptics {

struct CarveResult {
  double removed_mm3 = 0.0;  ///< equals the change of the solid field
  std::array<double, assets::kTissueCount> removed_mm3_by_label{};

  CarveResult& operator+=(const CarveResult& part) noexcept;
};

/// One step of `dt_s` with the bur at rest at `centre`. `tick` numbers the steps; it only steers rounding.
/// Non-finite or negative input removes nothing. Never throws or allocates.
CarveResult carveSphere(CarvedBone& bone, const calibration::Point<calibration::Patient>& centre_P, double radius_mm,
                        const ErosionParameters& erosion, double dt_s, std::uint64_t tick) noexcept;

/// The same for a bur that moves straight from `from` to `to` during `dt_s`: in equal steps of at most half a voxel,
/// and at most `kMostSweepSteps` of them. For poses too far apart to be taken as steps of their own.
CarveResult carveSweep(CarvedBone& bone, const calibration::Point<calibration::Patient>& from_P,
                       const calibration::Point<calibration::Patient>& to_P, double radius_mm,
                       const ErosionParameters& erosion, double dt_s, std::uint64_t tick) noexcept;
inline constexpr int kMostSweepSteps = 1024;

}  // namespace haptics
