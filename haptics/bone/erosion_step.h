// From an erosion law to the loss of one step (applied by bone/carve), with feedback from the volume removed. mm, N, s.
// Servo thread; under 0.1 us. Plain values, without contact or voxels.
//   time:       part of the first content lost = k f (1 - worn) |w| / w_rated dt: open loop, linear in time.
//   dose:       mm3/s = alpha f (1 - worn) mu F_n v_c, v_c = |w| sliding_arm; the loss grows with |r x axis|.
//   machining:  mm3/s = (1 - worn) min(swept, f P / u).
// f is the tissue's factor. A half-used voxel yields more than its visible part,
// one used up nothing. ErosionState learns that yield and carries the difference on, so that over tissues t
//   sum removed_t / rate_t = time spent cutting   (Agus: the work of friction is the work of removal).
// Nothing is owed out of contact, and no more than 5 % of the bur's overlap at any time.
#pragma once

#include <array>

#include "assets/tissue.h"
#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "haptics/bone/erosion.h"

namespace haptics {

struct ErosionStep {
  /// Fraction of its first content that a fully covered voxel of each tissue loses in this step; a bur that moves on
  /// within a long step may pass by with more than 1.
  std::array<double, assets::kTissueCount> loss{};
  /// Share of the loss that goes with the sliding speed of the bur's surface, |r x axis|: 0 everywhere alike, 1 none at
  /// the tip of a turning bur.
  double speed_share = 0.0;
  calibration::Vector<calibration::Patient> axis_P{{0.0, 0.0, 1.0}};  ///< of the spindle, unit
  double mean_arm_mm = 1.0;  ///< mean |r x axis| over the cut, so that the speed share changes where, not how much

  bool isZero() const { return loss == std::array<double, assets::kTissueCount>{}; }
};

/// The moment a step is worked out for.
struct CutConditions {
  double dt_s = 0.0;
  double spindle_rad_per_s = 0.0;  ///< either way round
  calibration::Vector<calibration::Patient> axis_P{{0.0, 0.0, 1.0}};
  double overlap_mm3 = 0.0;  ///< head and solid, before the cut
  // dose
  double normal_force_N = 0.0;
  double sliding_arm_mm = 0.0;  ///< mean |r x axis| where bur and bone rub (contact/sliding)
  // machining
  double swept_mm3_per_s = 0.0;  ///< solid the head's surface moves into (contact/machining)
  double power_Nmm_per_s = 0.0;  ///< the spindle can give to the chips (tool/spindle)
};

/// From step to step, part of the servo's state. Forget it when the bur leaves the bone.
struct ErosionState {
  double yield = 1.0;        ///< what a step took, relative to its loss of the overlap
  double deficit_mm3 = 0.0;  ///< of reference tissue, granted and not yet gone
};

/// Nothing for a spindle that stands, or a moment that is not a number.
ErosionStep erosionStep(const ErosionSettings& settings, const CutConditions& moment,
                        const ErosionState& memory) noexcept;

/// The memory after the step of this moment took `removed_mm3` of each tissue.
ErosionState updatedErosion(const ErosionSettings& settings, const CutConditions& moment, const ErosionState& memory,
                            const std::array<double, assets::kTissueCount>& removed_mm3) noexcept;

}  // namespace haptics
