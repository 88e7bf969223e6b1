#include "calibration/fit/touch_agreement.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "calibration/arm/phantom_models.h"
#include "calibration/fit/kinematic_fit.h"
#include "calibration/fit/rigid_fit.h"
#include "calibration/fit/touch_checks.h"

namespace calibration {
namespace {

using Indices = std::vector<std::size_t>;

constexpr double kLeastLimit_mm = 2.5;
constexpr double kMostLimit_mm = 13.0;  ///< an arm that is further from its model is another arm, or was never homed
/// An outlier is this far off and so many sigmas of a touch.
constexpr double kOutlier_mm = 1.5, kOutlierSigmas = 6.0;
constexpr std::size_t kEnoughForFull = 12, kHandful = 7;
constexpr int kAgreementRounds = 4;
constexpr double kFacing = 0.2;  ///< cosine of the plane's normal to the viewer, below which it faces nobody

/// Tips as the model has them, and where they were.
struct Places {
  Indices index;
  std::vector<glm::dvec3> tips_D, targets_W;
};

Places usedPlaces(const PhantomGeometry& geometry, const std::vector<Touch>& touches) {
  const MeasuredArm model{geometry, {}, {}};
  Places places;
  for (std::size_t i = 0; i < touches.size(); ++i) {
    if (!touches[i].used) continue;
    places.index.push_back(i);
    places.tips_D.push_back(model.tip_W(touches[i].joints_rad).mm);
    places.targets_W.push_back(touches[i].target_W.mm);
  }
  return places;
}

[[noreturn]] void refuseMirrored() {
  throw CalibrationError(
      "touches: they fit their mirror image and not themselves, a flip of the display is wrong or the targets' order "
      "is, check that the drawn F reads right, then touch again");
}

[[noreturn]] void refuseUnexplained(std::size_t n) {
  throw CalibrationError(fmt::format(
      "touches: no pose of this device brings two thirds of the {} within {:.0f} mm of their targets, check "
      "device model, homing and the order of the targets, then touch again",
      n, kMostLimit_mm));
}

/// The lay in the room's handedness; throws where the mirror's is clearly the better one. `doubtful`: of a handful of
/// touches the mirror's is a little better.
RigidAgreement rightHanded(const Places& places, bool& doubtful) {
  const auto agreement = [&](Handedness handedness, double most_limit_mm) {
    return rigidAgreement(places.tips_D, places.targets_W, handedness, kLeastLimit_mm, most_limit_mm);
  };
  const auto kept = agreement(Handedness::kept, kMostLimit_mm);
  const auto mirrored = agreement(Handedness::mirrored, kept ? kept->limit_mm : kMostLimit_mm);
  // Two thirds of a handful agree on much: there one touch more in the mirror tells, if they do not lie in a plane.
  const std::size_t n = places.index.size();
  const bool handful = n <= kHandful && extentOf(places.targets_W).spread_mm[2] > kFlatTargets_mm;
  const std::size_t clearly = handful ? 1 : std::max<std::size_t>(2, n / 20);
  if (mirrored) {
    if (!kept || mirrored->agreeing.size() >= kept->agreeing.size() + clearly) refuseMirrored();
    if (mirrored->agreeing.size() >= kept->agreeing.size() && kept->rms_mm > 0.5 * kLeastLimit_mm &&
        mirrored->rms_mm < 0.4 * kept->rms_mm)
      refuseMirrored();
  }
  if (!kept) refuseUnexplained(n);
  doubtful = n <= kHandful && mirrored && mirrored->agreeing.size() >= kept->agreeing.size() &&
             mirrored->rms_mm < kept->rms_mm;
  return *kept;
}

/// Of an arm fitted to those that agree: everybody it foretells.
Indices foretold(const TouchAgreement& agreement, const TouchSet& set, const Places& places, ArmModel model) {
  const KinematicFit fit =
      kinematicFit(agreement.start, set.touches, agreement.which, set.precision, parametersOf(model));
  const MeasuredArm arm = armOf(agreement.start, fit.parameters);
  const glm::dvec3 sigma_mm = touchSigma_mm(set.precision, fit.mismatch_mm);
  Indices which;
  for (const std::size_t i : places.index) {
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
  const Places places = usedPlaces(model.geometry, set.touches);
  bool doubtful = false;
  const RigidAgreement rigid = rightHanded(places, doubtful);

  TouchAgreement agreement;
  agreement.asked = static_cast<int>(places.index.size());
  glm::dvec3 middle_mm{0.0};
  for (const std::size_t k : rigid.agreeing) {
    agreement.which.push_back(places.index[k]);
    middle_mm += places.targets_W[k] / static_cast<double>(rigid.agreeing.size());
  }
  agreement.start = {model.geometry, {glm::normalize(glm::quat_cast(rigid.map.turn)), rigid.map.shift_mm}, {middle_mm}};

  // A finer arm is a finer assess, as far as there are touches enough for it.
  for (const ArmModel finer : {ArmModel::joint_gains, ArmModel::full}) {
    if (finer == ArmModel::full && places.index.size() < kEnoughForFull) break;
    for (int round = 0; round < kAgreementRounds; ++round) {
      Indices which = foretold(agreement, set, places, finer);
      const bool stays = which == agreement.which;
      if (3 * which.size() < 2 * places.index.size() || which.size() < 4) refuseUnexplained(places.index.size());
      agreement.which = std::move(which);
      if (stays) break;
    }
  }
  agreement.may_be_mirrored = doubtful || looksMirrored(agreement, set);
  return agreement;
}

}  // namespace calibration
