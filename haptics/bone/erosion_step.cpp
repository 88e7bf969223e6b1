#include "haptics/bone/erosion_step.h"

#include <algorithm>
#include <cmath>

#include "calibration/geometry/units.h"

namespace haptics {
namespace {

/// Part of the overlap that may be owed, and over which what is owed is made up for.
constexpr double kOwedShare = 0.05;
/// Dose over which the yield is learnt: several steps of 1/255 in every voxel, little of what changes the yield.
constexpr double kLearningDose = 0.02;
/// Where nearly all is used up the rest is not chased.
constexpr double kLeastYield = 0.05;
constexpr double kReference = 1.0;  ///< the factor of reference tissue
constexpr double kMillijoulesPerJoule = 1000.0;

double finite(double value) { return std::isfinite(value) ? std::max(0.0, value) : 0.0; }

/// Of a voxel's first content, by the law that is linear in time.
double timeLoss_per_s(const ErosionSettings& settings, const CutConditions& moment, double factor) {
  const double rated_rad_per_s = settings.time.rated_rpm * (2.0 * calibration::kPi / 60.0);
  return settings.time.removal_rate_per_s * factor * (1.0 - settings.worn) * std::abs(moment.spindle_rad_per_s) /
         rated_rad_per_s;
}

double rate_mm3_per_s(const ErosionSettings& settings, const CutConditions& moment, double factor) {
  const double sharp = 1.0 - settings.worn;
  if (moment.spindle_rad_per_s == 0.0) return 0.0;
  switch (settings.kind) {
    case ErosionKind::time:
      return finite(timeLoss_per_s(settings, moment, factor) * moment.overlap_mm3);
    case ErosionKind::dose: {
      const double sliding_mm_per_s = std::abs(moment.spindle_rad_per_s) * moment.sliding_arm_mm;
      const double friction_Nmm_per_s = settings.friction * finite(moment.normal_force_N) * sliding_mm_per_s;
      return finite(settings.dose.removal_mm3_per_J / kMillijoulesPerJoule * factor * sharp * friction_Nmm_per_s);
    }
    case ErosionKind::machining: {
      const double by_power =
          factor * moment.power_Nmm_per_s / (settings.machining.cutting_energy_J_per_mm3 * kMillijoulesPerJoule);
      return finite(sharp * std::min(moment.swept_mm3_per_s, by_power));
    }
  }
  return 0.0;
}

/// What a rate has to be multiplied by for the loss of an untouched voxel. What is owed is made up for while a share of
/// the overlap goes.
double lossPerRate(const CutConditions& moment, const ErosionState& memory) {
  const double made_up = 1.0 + std::clamp(memory.deficit_mm3 / (kOwedShare * moment.overlap_mm3), -1.0, 1.0);
  return finite(moment.dt_s) * made_up / (moment.overlap_mm3 * std::max(kLeastYield, memory.yield));
}

}  // namespace

ErosionStep erosionStep(const ErosionSettings& settings, const CutConditions& moment,
                        const ErosionState& memory) noexcept {
  ErosionStep step;
  step.axis_P = moment.axis_P;
  const auto& factor = settings.tissue_factor;
  if (settings.kind == ErosionKind::time) {
    for (std::size_t tissue = 0; tissue < factor.size(); ++tissue)
      step.loss[tissue] = finite(timeLoss_per_s(settings, moment, factor[tissue]) * finite(moment.dt_s));
    return step;
  }
  if (!(finite(moment.overlap_mm3) > 0.0)) return step;

  const double loss_per_rate = lossPerRate(moment, memory);
  for (std::size_t tissue = 0; tissue < factor.size(); ++tissue)
    step.loss[tissue] = finite(rate_mm3_per_s(settings, moment, factor[tissue]) * loss_per_rate);
  if (settings.kind == ErosionKind::dose && finite(moment.sliding_arm_mm) > 0.0) {
    step.speed_share = 1.0;
    step.mean_arm_mm = moment.sliding_arm_mm;
  }
  return step;
}

ErosionState updatedErosion(const ErosionSettings& settings, const CutConditions& moment, const ErosionState& memory,
                            const std::array<double, assets::kTissueCount>& removed_mm3) noexcept {
  const double reference_mm3_per_s = rate_mm3_per_s(settings, moment, kReference);
  if (settings.kind == ErosionKind::time || !(finite(moment.overlap_mm3) > 0.0)) return {};
  if (!(reference_mm3_per_s > 0.0)) return {memory.yield, 0.0};

  // What went, in terms of reference tissue, against what the step would have taken of an untouched overlap.
  double gone_mm3 = 0.0;
  for (std::size_t tissue = 0; tissue < removed_mm3.size(); ++tissue) {
    const double rate = rate_mm3_per_s(settings, moment, settings.tissue_factor[tissue]);
    if (rate > 0.0) gone_mm3 += removed_mm3[tissue] * reference_mm3_per_s / rate;
  }
  ErosionState next = memory;
  const double asked = std::min(1.0, reference_mm3_per_s * lossPerRate(moment, memory));
  if (asked > 0.0)
    next.yield += -std::expm1(-asked / kLearningDose) * (gone_mm3 / (asked * moment.overlap_mm3) - memory.yield);
  const double most_mm3 = kOwedShare * moment.overlap_mm3;
  next.deficit_mm3 =
      std::clamp(memory.deficit_mm3 + reference_mm3_per_s * finite(moment.dt_s) - gone_mm3, -most_mm3, most_mm3);
  return next;
}

}  // namespace haptics
