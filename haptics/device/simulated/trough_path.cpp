#include "haptics/device/simulated/trough_path.h"

#include <algorithm>
#include <cmath>

#include "calibration/geometry/units.h"
#include "haptics/device/haptic_device.h"

namespace haptics {
namespace {

constexpr double kApproach_mm_per_s = 20.0;
constexpr int kFinishingPasses = 4;  // at full depth, while the bone gives way
constexpr double kTilt_rad = 0.35;   // of the shaft towards the cheek, so that the handpiece clears the teeth

bool positive(double x) { return std::isfinite(x) && x > 0.0; }

}  // namespace

TroughPath::TroughPath(const assets::PlannedCut& cut, const CuttingMotion& motion,
                       const calibration::Pose<calibration::Device, calibration::Patient>& X_DP)
    : cut_(cut), motion_(motion), middle_D_mm_((X_DP * calibration::Point<calibration::Patient>{cut.middle_P_mm}).mm) {
  const glm::dvec3 outward_D = X_DP.rotation * cut.outward_P;
  const glm::dvec3 across = glm::cross(outward_D, X_DP.rotation * cut.lateral_P);
  const double area = glm::length(across);
  if (!(std::isfinite(glm::length(middle_D_mm_)) && std::isfinite(area) && area > 1e-6))
    throw DeviceError("scripted hand, its site or directions are not usable, give finite ones that are not parallel");
  if (!std::isfinite(glm::length(motion.shaft_P)))
    throw DeviceError("scripted hand, its shaft direction is not finite, give one that is, or zero");
  if (!positive(cut.bur_radius_mm) || !positive(cut.length_mm) || !positive(motion.speed_mm_per_s) ||
      !positive(cut.depth_mm) || !positive(motion.clearance_mm))
    throw DeviceError("scripted hand, a size or speed of its plan is not positive, give positive ones");

  outward_ = glm::normalize(outward_D);
  along_ = across / area;
  const glm::dvec3 buccal = glm::cross(along_, outward_), shaft_D = X_DP.rotation * motion.shaft_P;
  const double shaft_length = glm::length(shaft_D);
  const glm::dvec3 shaft =
      shaft_length > 0.0 ? shaft_D / shaft_length : std::cos(kTilt_rad) * outward_ + std::sin(kTilt_rad) * buccal;
  rotation_ = glm::normalize(glm::dquat(glm::dvec3(0.0, 0.0, 1.0), shaft));

  deepening_passes_ = std::max(1, static_cast<int>(std::ceil(cut.depth_mm / (cut.bur_radius_mm / 8.0))));
  passes_ = deepening_passes_ + kFinishingPasses;
  pass_s_ = cut.length_mm / motion.speed_mm_per_s;
  approach_s_ = retreat_s_ = motion.clearance_mm / kApproach_mm_per_s * 1.5;
}

HandTarget TroughPath::at(double t_s) const {
  // Height of the bur's centre over the surface, position along the stroke.
  const double rest_mm = cut_.bur_radius_mm, high_mm = rest_mm + motion_.clearance_mm;
  const double cut_s = t_s - approach_s_, end_s = passes_ * pass_s_;
  const double step_mm = cut_.depth_mm / deepening_passes_;
  double height_mm = high_mm, along_mm = -0.5 * cut_.length_mm;
  if (cut_s <= 0.0) {
    height_mm = glm::mix(high_mm, rest_mm, eased(t_s / approach_s_));
  } else if (cut_s < end_s) {
    const double pass = std::floor(cut_s / pass_s_), u = cut_s / pass_s_ - pass;
    // Eases in and out of each reversal; sinks to the pass's depth in its first fifth.
    const double way = 0.5 - 0.5 * std::cos(u * calibration::kPi);
    along_mm = cut_.length_mm * ((static_cast<int>(pass) % 2 == 0 ? way : 1.0 - way) - 0.5);
    height_mm = rest_mm - std::min(cut_.depth_mm, step_mm * (pass + eased(5.0 * u)));
  } else {
    along_mm = cut_.length_mm * ((passes_ % 2 == 0 ? 0.0 : 1.0) - 0.5);
    height_mm = glm::mix(rest_mm - cut_.depth_mm, high_mm, eased((cut_s - end_s) / retreat_s_));
  }
  const bool pedal = cut_s > -0.1 * approach_s_ && cut_s < end_s;
  return {middle_D_mm_ + height_mm * outward_ + along_mm * along_, rotation_, pedal, 0, true};
}

}  // namespace haptics
