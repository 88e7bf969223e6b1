#include "calibration/fit/arm_fit.h"

#include <algorithm>
#include <cmath>

#include "calibration/arm/phantom_models.h"
#include "calibration/fit/arm_problem.h"
#include "calibration/fit/cross_validation.h"
#include "calibration/fit/kinematic_fit.h"
#include "calibration/fit/touch_agreement.h"
#include "calibration/fit/touch_checks.h"

namespace calibration {
namespace {

using Indices = std::vector<std::size_t>;

constexpr std::array kModels = {ArmModel::rigid, ArmModel::joint_gains, ArmModel::full};
constexpr std::size_t kAffineNumbers = 12;
constexpr double kSimplerIsPreferred = 1.1;  ///< ratio of mean squares
constexpr double kOtherTilt_rad = radFromDegrees(25.0);

struct Candidate {
  ArmModel model = ArmModel::rigid;
  KinematicFit fit;
  MeasuredArm arm;
  double fre_rms_mm = 0.0;
  CrossValidation unseen;
};

Candidate candidate(ArmModel model, const TouchAgreement& agreement, const TouchSet& set) {
  Candidate c;
  c.model = model;
  c.fit = kinematicFit(agreement.start, set.touches, agreement.which, set.precision, parametersOf(model));
  c.arm = armOf(agreement.start, c.fit.parameters);
  c.fre_rms_mm = rms_mm(c.arm, set.touches, agreement.which);
  c.unseen = crossValidated(agreement.start, set.touches, agreement.which, set.precision, c.fit);
  return c;
}

/// The best on touches it was not fitted to; of two nearly equal ones the simpler.
const Candidate& chosen(const std::vector<Candidate>& candidates, int used, double tilt_spread_deg) {
  std::size_t best = 0;
  for (std::size_t k = 1; k < candidates.size(); ++k) {
    if (candidates[k].model == ArmModel::full && (used < kMinForFullModel || tilt_spread_deg < kMinTilt_deg)) continue;
    if (std::pow(candidates[best].unseen.relative / candidates[k].unseen.relative, 2) > kSimplerIsPreferred) best = k;
  }
  return candidates[best];
}

/// Predicted tip error at the same positions with other stylus tilts, from the covariance of the parameters.
double unseenTilts_mm(const TouchAgreement& agreement, const TouchSet& set, const KinematicFit& fit) {
  const std::size_t n = fit.fitted.size();
  if (fit.covariance.empty()) return 0.0;
  double sum = 0.0;
  int count = 0;
  for (const std::size_t i : agreement.which)
    for (const auto& [side, up] :
         {std::pair{-1.0, -1.0}, std::pair{-1.0, 1.0}, std::pair{1.0, -1.0}, std::pair{1.0, 1.0}}) {
      RawJoints raw = set.touches[i].joints_rad;
      raw[3] += side * kOtherTilt_rad;
      raw[4] += up * kOtherTilt_rad;
      const TipJacobian slopes = tipJacobian(agreement.start, fit.parameters, raw);
      for (std::size_t a = 0; a < n; ++a)
        for (std::size_t b = 0; b < n; ++b)
          sum += fit.covariance[a * n + b] *
                 glm::dot(slopes.by_parameter[fit.fitted[a]], slopes.by_parameter[fit.fitted[b]]);
      ++count;
    }
  return std::sqrt(sum / count);
}

/// Expected RMS of the residuals from the touches' precision alone.
double expectedFre_mm(const TouchPrecision& precision, double effective_parameters, std::size_t n) {
  const glm::dvec3 sigma = touchSigma_mm(precision, 0.0);
  return std::sqrt(glm::dot(sigma, sigma) * std::max(0.0, 1.0 - effective_parameters / static_cast<double>(3 * n)));
}

std::vector<glm::dvec3> targetsOf(const std::vector<Touch>& touches, const Indices& which) {
  std::vector<glm::dvec3> targets;
  for (const std::size_t i : which) targets.push_back(touches[i].target_W.mm);
  return targets;
}

void describeResiduals(const TouchSet& set, const Indices& which, ArmFit& fit) {
  fit.residuals = residualsOf(fit.arm, set.touches);
  for (Residual& residual : fit.residuals) residual.used = false;
  for (const std::size_t i : which) {
    fit.residuals[i].used = true;
    fit.bias_mm.xyz += fit.residuals[i].error_mm.xyz / static_cast<double>(which.size());
  }
}

}  // namespace

std::string_view nameOf(ArmModel model) {
  return model == ArmModel::rigid ? "rigid" : model == ArmModel::joint_gains ? "joints" : "full";
}

std::optional<ArmModel> armModelNamed(std::string_view name) {
  for (const ArmModel model : kModels)
    if (name == nameOf(model)) return model;
  return std::nullopt;
}

ArmFit fitArm(const TouchSet& set, const FitOptions& options) {
  checkTouches(set);
  const TouchAgreement agreement = touchAgreement(set);
  const Indices& which = agreement.which;

  ArmFit fit;
  std::vector<Candidate> candidates;
  for (const ArmModel model : kModels) {
    candidates.push_back(candidate(model, agreement, set));
    const Candidate& c = candidates.back();
    fit.scores.push_back(
        {std::string(nameOf(model)), static_cast<int>(c.fit.fitted.size()), c.fre_rms_mm, c.unseen.rms_mm});
  }
  if (const auto affine = affineScore(agreement.start, set.touches, which))
    fit.scores.push_back({"affine", kAffineNumbers, affine->fre_rms_mm, affine->cv_rms_mm});

  fit.used = static_cast<int>(which.size());
  fit.outliers = agreement.asked - fit.used;
  fit.tilt_spread_deg = tiltSpread_deg(agreement.start.geometry, set.touches, which);
  const Candidate& best = options.model ? candidates[static_cast<std::size_t>(*options.model)]
                                        : chosen(candidates, fit.used, fit.tilt_spread_deg);
  fit.model = best.model;
  fit.arm = best.arm;
  fit.fre_rms_mm = best.fre_rms_mm;
  fit.cv_rms_mm = best.unseen.rms_mm;
  fit.mismatch_mm = best.fit.mismatch_mm;
  fit.iterations = best.fit.iterations;
  fit.sigma.assign(best.fit.sigma.begin(), best.fit.sigma.end());
  fit.expected_fre_mm = expectedFre_mm(set.precision, best.fit.effective_parameters, which.size());
  describeResiduals(set, which, fit);

  const std::vector<glm::dvec3> targets = targetsOf(set.touches, which);
  fit.hull_mm3 = hullVolume_mm3(targets);
  fit.warnings = fitWarnings({.used = fit.used,
                              .outliers = fit.outliers,
                              .tilt_spread_deg = fit.tilt_spread_deg,
                              .hull_mm3 = fit.hull_mm3,
                              .region_mm3 = options.region_mm3,
                              .flat = extentOf(targets).spread_mm[2] < kFlatTargets_mm,
                              .may_be_mirrored = agreement.may_be_mirrored,
                              .fre_rms_mm = fit.fre_rms_mm,
                              .cv_rms_mm = fit.cv_rms_mm,
                              .unseen_tilts_rms_mm = unseenTilts_mm(agreement, set, candidates.back().fit)});
  return fit;
}

std::vector<Residual> residualsOf(const MeasuredArm& arm, const std::vector<Touch>& touches) {
  std::vector<Residual> residuals;
  for (const Touch& touch : touches)
    residuals.push_back({touch.id, touch.target_W, arm.tip_W(touch.joints_rad) - touch.target_W, touch.used});
  return residuals;
}

}  // namespace calibration
