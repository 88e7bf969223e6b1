// From an erosion law to the loss of one step (applied by bone/carve), with feedback from the volume removed. mm, N, s.
// Servo thread; under 0.1 us. Plain values, without contact or voxels. f is the tissue's factor.
//   time:       part of the first content lost = k f (1 - worn) |w| / w_rated dt: open loop, linear in time.
//   dose:       mm3/s = alpha f (1 - worn) mu F_n v_c, v_c = |w| sliding_arm; the loss grows with |r x axis|.
//   machining:  mm3/s = (1 - worn) min(swept, f P / u).
// The last two use feedback: partly cut voxels yield more than their visible content, voxels at their cap nothing.
// ErosionState learns the yield and carries the deficit on, at most 5 % of the overlap and none out of contact, so that
//   sum removed_t / rate_t = time spent cutting, over tissues t   (Agus: work of friction = work of removal).
#pragma once

#include <array>

#include "assets/tissue.h"
#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "haptics/bone/erosion.h"

namespace haptics {

struct ErosionStep {
  /// Fraction of its first content that a fully covered voxel of each tissue loses; may exceed 1 for a bur that moves
  /// within a long step.
  std::array<double, assets::kTissueCount> loss{};
  /// Share of the loss proportional to the sliding speed of the bur's surface, |r x axis|: 0 the same everywhere, 1
  /// none at the tip.
  double speed_share = 0.0;
  calibration::Vector<calibration::Patient> axis_P{{0.0, 0.0, 1.0}};  ///< of the spindle, unit
  double mean_arm_mm = 1.0;  ///< mean |r x axis| over the cut: the speed share changes where, not how much

  bool isZero() const { return loss == std::array<double, assets::kTissueCount>{}; }
};

/// Inputs of a step.
struct CutConditions {
  double dt_s = 0.0;
  double spindle_rad_per_s = 0.0;  ///< signed
  calibration::Vector<calibration::Patient> axis_P{{0.0, 0.0, 1.0}};
  double overlap_mm3 = 0.0;  ///< head and solid, before the cut
  // dose
  double normal_force_N = 0.0;
  double sliding_arm_mm = 0.0;  ///< mean |r x axis| over the contact (contact/sliding)
  // machining
  double swept_mm3_per_s = 0.0;  ///< solid swept by the head's surface (contact/machining)
  double power_Nmm_per_s = 0.0;  ///< available from the spindle (tool/spindle)
};

/// Part of the servo's state. Reset when the bur leaves the bone.
struct ErosionState {
  double yield = 1.0;        ///< volume removed relative to the loss of the overlap
  double deficit_mm3 = 0.0;  ///< of reference tissue, due but not yet removed
};

/// Zero for a spindle at rest or conditions that are not finite.
ErosionStep erosionStep(const ErosionSettings& settings, const CutConditions& conditions,
                        const ErosionState& state) noexcept;

/// The state after this step removed `removed_mm3` of each tissue.
ErosionState updatedErosion(const ErosionSettings& settings, const CutConditions& conditions, const ErosionState& state,
                            const std::array<double, assets::kTissueCount>& removed_mm3) noexcept;

}  // namespace haptics
