// Force and slope of a law in flat bone, its steepest slope, and whether a device of limited stiffness can render it
// (passivity: K <= 2 (b - B) / T, reference/physics 2.5). Closed forms for balls (physics 2.4), flat overlaps for other
// heads (tool/flat_overlap). mm, N, s. Not for the servo: up to 0.5 ms. Stiffness factor 1 unless stated otherwise.
#pragma once

#include "haptics/contact/law_parameters.h"

namespace haptics {

struct FlatResponse {
  double force_N = 0.0;
  double slope_N_per_mm = 0.0;
};

/// In flat bone, `cos_axis` between +z of T and the face's normal: 1 is tip down. Machining: the wall at rest. For a
/// head with a flat end or a long side, surface laws are averaged over 0.1 mm of depth, a voxel's transition.
FlatResponse flatResponse(const LawSettings& law, const BurShape& head, double depth_mm, double cos_axis) noexcept;

/// Largest dF/dh over the depths a proxy allows, in the hardest tissue: pi P / R for forssim's ball.
double stiffestSlope_N_per_mm(const LawSettings& law, const BurShape& head) noexcept;

/// Stiffness a device of damping b can render at this servo period with the law's damping: 2 (b - B) / T.
double passiveStiffness_N_per_mm(double device_damping_Ns_per_mm, double law_damping_Ns_per_mm,
                                 double period_s) noexcept;

struct Admission {
  enum class Answer : std::uint8_t { yes, no_such_head, too_stiff };
  Answer answer = Answer::yes;
  double slope_N_per_mm = 0.0;          ///< of the law
  const LawParameter* lower = nullptr;  ///< too_stiff: the parameter to reduce …
  double nearest = 0.0;                 ///< … and its largest allowed value
};

/// Whether a device limited to `max_N_per_mm` can render the law with this head.
Admission admissible(const LawSettings& law, const BurShape& head, double max_N_per_mm) noexcept;

}  // namespace haptics
