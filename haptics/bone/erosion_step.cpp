#include "haptics/bone/erosion_step.h"

#include <algorithm>
#include <cmath>

#include "calibration/geometry/units.h"

namespace haptics {
namespace {

/// Limit of the deficit, as part of the overlap, and the part over which it is made up.
constexpr double kDeficitShare = 0.05;
/// Dose over which the yield is learnt: several steps of 1/255 in every voxel.
constexpr double kLearningDose = 0.02;
/// Limit where nearly all is used up.
constexpr double kMinYield = 0.05;
constexpr double kReference = 1.0;  ///< the factor of reference tissue
constexpr double kMillijoulesPerJoule = 1000.0;

double finite(double value) { return std::isfinite(value) ? std::max(0.0, value) : 0.0; }

/// Part of a voxel's first content, by the law linear in time.
double timeLoss_per_s(const ErosionSettings& settings, const CutConditions& conditions, double factor) {
  const double rated_rad_per_s = settings.time.rated_rpm * (2.0 * calibration::kPi / 60.0);
  return settings.time.removal_rate_per_s * factor * (1.0 - settings.worn) * std::abs(conditions.spindle_rad_per_s) /
         rated_rad_per_s;
}

double rate_mm3_per_s(const ErosionSettings& settings, const CutConditions& conditions, double factor) {
  const double sharp = 1.0 - settings.worn;
  if (conditions.spindle_rad_per_s == 0.0) return 0.0;
  switch (settings.kind) {
    case ErosionKind::time:
      return finite(timeLoss_per_s(settings, conditions, factor) * conditions.overlap_mm3);
    case ErosionKind::dose: {
      const double sliding_mm_per_s = std::abs(conditions.spindle_rad_per_s) * conditions.sliding_arm_mm;
      const double friction_Nmm_per_s = settings.friction * finite(conditions.normal_force_N) * sliding_mm_per_s;
      return finite(settings.dose.removal_mm3_per_J / kMillijoulesPerJoule * factor * sharp * friction_Nmm_per_s);
    }
    case ErosionKind::machining: {
      const double by_power =
          factor * conditions.power_Nmm_per_s / (settings.machining.cutting_energy_J_per_mm3 * kMillijoulesPerJoule);
      return finite(sharp * std::min(conditions.swept_mm3_per_s, by_power));
    }
  }
  return 0.0;
}

/// Factor from a rate to the loss of an untouched voxel. The deficit is made up while a share of the overlap is
/// removed.
double lossPerRate(const CutConditions& conditions, const ErosionState& state) {
  const double made_up = 1.0 + std::clamp(state.deficit_mm3 / (kDeficitShare * conditions.overlap_mm3), -1.0, 1.0);
  return finite(conditions.dt_s) * made_up / (conditions.overlap_mm3 * std::max(kMinYield, state.yield));
}

}  // namespace

ErosionStep erosionStep(const ErosionSettings& settings, const CutConditions& conditions,
                        const ErosionState& state) noexcept {
  ErosionStep step;
  step.axis_P = conditions.axis_P;
  const auto& factor = settings.tissue_factor;
  if (settings.kind == ErosionKind::time) {
    for (std::size_t tissue = 0; tissue < factor.size(); ++tissue)
      step.loss[tissue] = finite(timeLoss_per_s(settings, conditions, factor[tissue]) * finite(conditions.dt_s));
    return step;
  }
  if (!(finite(conditions.overlap_mm3) > 0.0)) return step;

  const double loss_per_rate = lossPerRate(conditions, state);
  for (std::size_t tissue = 0; tissue < factor.size(); ++tissue)
    step.loss[tissue] = finite(rate_mm3_per_s(settings, conditions, factor[tissue]) * loss_per_rate);
  if (settings.kind == ErosionKind::dose && finite(conditions.sliding_arm_mm) > 0.0) {
    step.speed_share = 1.0;
    step.mean_arm_mm = conditions.sliding_arm_mm;
  }
  return step;
}

ErosionState updatedErosion(const ErosionSettings& settings, const CutConditions& conditions, const ErosionState& state,
                            const std::array<double, assets::kTissueCount>& removed_mm3) noexcept {
  const double reference_mm3_per_s = rate_mm3_per_s(settings, conditions, kReference);
  if (settings.kind == ErosionKind::time || !(finite(conditions.overlap_mm3) > 0.0)) return {};
  if (!(reference_mm3_per_s > 0.0)) return {state.yield, 0.0};

  // The removed volume as reference tissue, against that of an untouched overlap.
  double removed_reference_mm3 = 0.0;
  for (std::size_t tissue = 0; tissue < removed_mm3.size(); ++tissue) {
    const double rate = rate_mm3_per_s(settings, conditions, settings.tissue_factor[tissue]);
    if (rate > 0.0) removed_reference_mm3 += removed_mm3[tissue] * reference_mm3_per_s / rate;
  }
  ErosionState next = state;
  const double requested = std::min(1.0, reference_mm3_per_s * lossPerRate(conditions, state));
  if (requested > 0.0)
    next.yield += -std::expm1(-requested / kLearningDose) *
                  (removed_reference_mm3 / (requested * conditions.overlap_mm3) - state.yield);
  const double limit_mm3 = kDeficitShare * conditions.overlap_mm3;
  next.deficit_mm3 = std::clamp(
      state.deficit_mm3 + reference_mm3_per_s * finite(conditions.dt_s) - removed_reference_mm3, -limit_mm3, limit_mm3);
  return next;
}

}  // namespace haptics
