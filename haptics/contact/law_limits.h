// What a law asks of a device, before it is used: its force and slope in flat bone, its steepest slope, and whether a
// device that can hold so much stiffness can render it (passivity: K <= 2 (b - B) / T, reference/physics 2.5). Closed
// forms for balls (physics 2.4), flat overlaps for other heads (tool/flat_overlap). mm, N, s. Any thread, not the
// servo's: up to 0.5 ms. Bone of stiffness factor 1, unless said otherwise.
#pragma once

#include "haptics/contact/law_parameters.h"

namespace haptics {

struct FlatResponse {
  double force_N = 0.0;
  double slope_N_per_mm = 0.0;
};

/// Of flat bone, `cos_axis` between +z of T and the face's normal: 1 is tip down. Machining: at rest, the wall. A head
/// with a flat end or a long side has its surface's law averaged over 0.1 mm of depth, a voxel's transition.
FlatResponse flatResponse(const LawSettings& law, const BurShape& head, double depth_mm, double cos_axis) noexcept;

/// The largest dF/dh over every depth the law may serve, in the hardest of the tissues: pi P / R for forssim's ball.
double stiffestSlope_N_per_mm(const LawSettings& law, const BurShape& head) noexcept;

/// What a device of damping b holds at this servo period beside the law's own damping: 2 (b - B) / T.
double passiveStiffness_N_per_mm(double device_damping_Ns_per_mm, double law_damping_Ns_per_mm,
                                 double period_s) noexcept;

struct Admission {
  enum class Answer : std::uint8_t { yes, no_such_head, too_stiff };
  Answer answer = Answer::yes;
  double slope_N_per_mm = 0.0;          ///< what the law asks for
  const LawParameter* lower = nullptr;  ///< too_stiff: the parameter to lower …
  double nearest = 0.0;                 ///< … and the largest value of it that is allowed
};

/// Whether a device that holds `most_N_per_mm` can render the law with this head.
Admission admissible(const LawSettings& law, const BurShape& head, double most_N_per_mm) noexcept;

}  // namespace haptics
