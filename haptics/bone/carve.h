// Cutting: what a turning bur takes from the bone in one step. mm³ per second, whatever the voxel size, the tick rate
// and the order of the voxels. Frame P, mm, s. Servo thread (or any one thread that owns the bone). A voxel covered by
// the fraction g loses g * loss of what it held at first, until its dose reaches the largest g it has seen: linear in
// dose, and never more than the swept volume however long the bur stays. `loss` is per tissue and step, from the
// erosion law (bone/erosion_step). Cost: some 4 ns per solid voxel touched. Not the force (contact).
#pragma once

#include <array>
#include <cstdint>

#include "assets/tissue.h"
#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "haptics/bone/carved_bone.h"
#include "haptics/bone/erosion_step.h"
#include "haptics/tool/bur_shape.h"

namespace haptics {

struct CarveResult {
  double removed_mm3 = 0.0;  ///< equals the change of the solid field
  std::array<double, assets::kTissueCount> removed_mm3_by_label{};

  CarveResult& operator+=(const CarveResult& part) noexcept;
};

/// One step with the bur at rest at `centre`. `tick` numbers the steps: it steers rounding and, if `turns` is not 1,
/// which blocks have their turn: every block in one of `turns` steps, and then with `turns` times the loss, which is
/// the same mm³ per second for 1/turns of the work. `strokes` may be null: what is cut cannot be taken back then.
/// Non-finite or negative input removes nothing. Never throws or allocates.
CarveResult carveSphere(CarvedBone& bone, const calibration::Point<calibration::Patient>& centre_P, double radius_mm,
                        const ErosionStep& step, std::uint64_t tick, int turns = 1,
                        StrokeHistory* strokes = nullptr) noexcept;

/// The same with a head of any shape, as it stands.
CarveResult carveTool(CarvedBone& bone, const BurShape& head,
                      const calibration::Pose<calibration::Patient, calibration::Tool>& X_PT, const ErosionStep& step,
                      std::uint64_t tick, int turns = 1, StrokeHistory* strokes = nullptr) noexcept;

/// As many turns as keep a tick with this bur short, while no tissue loses more than three quarters of a voxel in a
/// turn.
int carveInterleave(const CarvedBone& bone, double radius_mm, const ErosionStep& step) noexcept;
/// The same for a head of any shape: of a ball with its surface.
int carveInterleave(const CarvedBone& bone, const BurShape& head, const ErosionStep& step) noexcept;

/// One step for a head that moves straight from `from` to `to` during it and turns evenly on its way: in equal parts in
/// which no point of it moves more than half a voxel, at most `kMaxSweepSteps` of them. For poses too far apart to be
/// taken as steps of their own.
CarveResult carveSweep(CarvedBone& bone, const BurShape& head,
                       const calibration::Pose<calibration::Patient, calibration::Tool>& from_X_PT,
                       const calibration::Pose<calibration::Patient, calibration::Tool>& to_X_PT,
                       const ErosionStep& step, std::uint64_t tick) noexcept;
inline constexpr int kMaxSweepSteps = 1024;

}  // namespace haptics
