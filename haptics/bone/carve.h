// Cutting: what a turning bur removes from the bone in one step, in mm³ per second independent of voxel size, tick rate
// and order of the voxels. Frame P, mm, s. The thread that owns the bone. A voxel covered by the fraction g loses
// g * loss of its first content until its dose reaches the largest g so far: linear in dose, and never more than the
// swept volume. `loss` is per tissue and step, from the erosion law (bone/erosion_step). About 4 ns per solid voxel
// touched; no allocation, no throw. Forces: contact.
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

class Filling;

struct CarveResult {
  double removed_mm3 = 0.0;  ///< equals the change of the solid field
  std::array<double, assets::kTissueCount> removed_mm3_by_label{};

  CarveResult& operator+=(const CarveResult& part) noexcept;
};

/// One step with the bur at rest at `centre`. `tick` numbers the steps: it seeds the rounding and, if `interleave` is
/// not 1, selects the blocks: each is cut in one of `interleave` steps with `interleave` times the loss, the same mm³
/// per second for a fraction of the work. `strokes` may be null: no undo. Non-finite or negative input removes nothing.
CarveResult carveSphere(CarvedBone& bone, const calibration::Point<calibration::Patient>& centre_P, double radius_mm,
                        const ErosionStep& step, std::uint64_t tick, int interleave = 1,
                        StrokeHistory* strokes = nullptr) noexcept;

/// The same with a head of any shape at rest.
CarveResult carveTool(CarvedBone& bone, const BurShape& head,
                      const calibration::Pose<calibration::Patient, calibration::Tool>& X_PT, const ErosionStep& step,
                      std::uint64_t tick, int interleave = 1, StrokeHistory* strokes = nullptr) noexcept;

/// The same of a filling.
CarveResult carveTool(Filling& filling, const BurShape& head,
                      const calibration::Pose<calibration::Patient, calibration::Tool>& X_PT, const ErosionStep& step,
                      std::uint64_t tick, int interleave = 1, StrokeHistory* strokes = nullptr) noexcept;

/// `interleave` that keeps a tick with this head short: by the surface of the head, while no tissue of a scan loses
/// more than three quarters of a voxel in a step.
int carveInterleave(const CarvedBone& bone, const BurShape& head, const ErosionStep& step) noexcept;

/// One step for a head that moves straight from `from` to `to` and turns evenly: in equal parts in which no point moves
/// more than half a voxel, at most `kMaxSweepSteps`. For poses too far apart to be steps of their own.
CarveResult carveSweep(CarvedBone& bone, const BurShape& head,
                       const calibration::Pose<calibration::Patient, calibration::Tool>& from_X_PT,
                       const calibration::Pose<calibration::Patient, calibration::Tool>& to_X_PT,
                       const ErosionStep& step, std::uint64_t tick) noexcept;
inline constexpr int kMaxSweepSteps = 1024;

}  // namespace haptics
