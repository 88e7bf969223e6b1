#include "calibration/fit/touch_agreement.h"

#include <algorithm>

#include <fmt/format.h>

#include "calibration/arm/phantom_models.h"
#include "calibration/fit/kinematic_fit.h"
#include "calibration/fit/rigid_fit.h"
#include "calibration/fit/touch_checks.h"

namespace calibration {
namespace {

using Indices = std::vector<std::size_t>;

constexpr double kMinLimit_mm = 2.5;
constexpr double kMaxLimit_mm = 13.0;  ///< beyond it the arm is another one or was never homed
/// An outlier exceeds this distance and so many sigmas of a touch.
constexpr double kOutlier_mm = 1.5, kOutlierSigmas = 6.0;
constexpr std::size_t kEnoughForFull = 12, kHandful = 7;
constexpr int kAgreementRounds = 4;
constexpr double kFacing = 0.2;  ///< cosine of the plane's normal to the viewer

/// Tips by the model, and targets.
struct Positions {
  Indices index;
  std::vector<glm::dvec3> tips_D, targets_W;
};

Positions usedPositions(const PhantomGeometry& geometry, const std::vector<Touch>& touches) {
  const MeasuredArm model{geometry, {}, {}};
  Positions positions;
  for (std::size_t i = 0; i < touches.size(); ++i) {
    if (!touches[i].used) continue;
    positions.index.push_back(i);
    positions.tips_D.push_back(model.tip_W(touches[i].joints_rad).mm);
    positions.targets_W.push_back(touches[i].target_W.mm);
  }
  return positions;
}

[[noreturn]] void refuseMirrored() {
  throw CalibrationError(
      "touches: they fit mirrored, not as they are; the display is flipped or the targets' order "
      "is wrong, check that the drawn F reads right, then touch again");
}

[[noreturn]] void refuseUnexplained(std::size_t n) {
  throw CalibrationError(fmt::format(
      "touches: no pose of this device brings two thirds of the {} within {:.0f} mm of their targets, check "
      "device model, homing and the order of the targets, then touch again",
      n, kMaxLimit_mm));
}

/// The right-handed registration; throws where the mirrored one is clearly better. `doubtful`: with few touches the
/// mirrored one is slightly better.
RigidAgreement rightHanded(const Positions& positions, bool& doubtful) {
  const auto agreement = [&](Handedness handedness, double max_limit_mm) {
    return rigidAgreement(positions.tips_D, positions.targets_W, handedness, kMinLimit_mm, max_limit_mm);
  };
  const auto kept = agreement(Handedness::kept, kMaxLimit_mm);
  const auto mirrored = agreement(Handedness::mirrored, kept ? kept->limit_mm : kMaxLimit_mm);
  // With few touches, one more in the mirrored fit is significant unless they lie in a plane.
  const std::size_t n = positions.index.size();
  const bool handful = n <= kHandful && extentOf(positions.targets_W).spread_mm[2] > kFlatTargets_mm;
  const std::size_t clearly = handful ? 1 : std::max<std::size_t>(2, n / 20);
  if (mirrored) {
    if (!kept || mirrored->agreeing.size() >= kept->agreeing.size() + clearly) refuseMirrored();
    if (mirrored->agreeing.size() >= kept->agreeing.size() && kept->rms_mm > 0.5 * kMinLimit_mm &&
        mirrored->rms_mm < 0.4 * kept->rms_mm)
      refuseMirrored();
  }
  if (!kept) refuseUnexplained(n);
  doubtful = n <= kHandful && mirrored && mirrored->agreeing.size() >= kept->agreeing.size() &&
             mirrored->rms_mm < kept->rms_mm;
  return *kept;
}

/// The touches that an arm fitted to the agreeing ones predicts.
Indices predicted(const TouchAgreement& agreement, const TouchSet& set, const Positions& positions, ArmModel model) {
  const KinematicFit fit =
      kinematicFit(agreement.start, set.touches, agreement.which, set.precision, parametersOf(model));
  const MeasuredArm arm = armOf(agreement.start, fit.parameters);
  const glm::dvec3 sigma_mm = touchSigma_mm(set.precision, fit.mismatch_mm);
  Indices which;
  for (const std::size_t i : positions.index) {
    const glm::dvec3 error = arm.tip_W(set.touches[i].joints_rad).mm - set.touches[i].target_W.mm;
    if (glm::length(error) < kOutlier_mm || glm::length(error / sigma_mm) < kOutlierSigmas) which.push_back(i);
  }
  return which;
}

bool looksMirrored(const TouchAgreement& agreement, const TouchSet& set) {
  std::vector<glm::dvec3> targets;
  glm::dvec3 stylus_W{0.0};
  const MeasuredArm model{agreement.start.geometry, {}, agreement.start.X_WD};
  for (const std::size_t i : agreement.which) {
    targets.push_back(set.touches[i].target_W.mm);
    stylus_W += model.X_WH(set.touches[i].joints_rad).rotation * glm::dvec3(0.0, 0.0, 1.0);
  }
  const Extent extent = extentOf(targets);
  const glm::dvec3 normal = extent.axes[2] * (extent.axes[2].z < 0.0 ? -1.0 : 1.0);
  return extent.spread_mm[2] < kFlatTargets_mm && normal.z > kFacing && glm::dot(normal, stylus_W) < 0.0;
}

}  // namespace

TouchAgreement touchAgreement(const TouchSet& set) {
  const PhantomModel& model = *findPhantomModel(set.device_model);
  const Positions positions = usedPositions(model.geometry, set.touches);
  bool doubtful = false;
  const RigidAgreement rigid = rightHanded(positions, doubtful);

  TouchAgreement agreement;
  agreement.asked = static_cast<int>(positions.index.size());
  glm::dvec3 middle_mm{0.0};
  for (const std::size_t k : rigid.agreeing) {
    agreement.which.push_back(positions.index[k]);
    middle_mm += positions.targets_W[k] / static_cast<double>(rigid.agreeing.size());
  }
  agreement.start = {
      model.geometry, {glm::normalize(glm::quat_cast(rigid.map.rotation)), rigid.map.translation_mm}, {middle_mm}};

  // Refine with larger models, as far as there are enough touches.
  for (const ArmModel finer : {ArmModel::joint_gains, ArmModel::full}) {
    if (finer == ArmModel::full && positions.index.size() < kEnoughForFull) break;
    for (int round = 0; round < kAgreementRounds; ++round) {
      Indices which = predicted(agreement, set, positions, finer);
      const bool stays = which == agreement.which;
      if (3 * which.size() < 2 * positions.index.size() || which.size() < 4) refuseUnexplained(positions.index.size());
      agreement.which = std::move(which);
      if (stays) break;
    }
  }
  agreement.may_be_mirrored = doubtful || looksMirrored(agreement, set);
  return agreement;
}

}  // namespace calibration
