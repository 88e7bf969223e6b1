#include "haptics/device/simulated/trough_path.h"

#include <algorithm>
#include <cmath>

#include "calibration/geometry/units.h"
#include "haptics/device/haptic_device.h"

namespace haptics {
namespace {

constexpr double kPedalBefore = 0.1;  // of the approach
constexpr double kMeets_mm = 1.6;     // ends of strokes that are joined in the bone
constexpr double kTilt_rad = 0.35;    // of the shaft towards the cheek, so that the handpiece clears the teeth
constexpr double kLeastSteep = 0.6;   // cosine between shaft and the way out of the bone
constexpr double kLeast_s = 0.02;

bool positive(double x) { return std::isfinite(x) && x > 0.0; }

}  // namespace

TroughPath::TroughPath(const assets::PlannedCut& cut, const CuttingMotion& motion,
                       const calibration::Pose<calibration::Device, calibration::Patient>& X_DP) {
  const glm::dvec3 outward_D = X_DP.rotation * cut.outward_P;
  const glm::dvec3 across = glm::cross(outward_D, X_DP.rotation * cut.lateral_P);
  std::vector<std::vector<glm::dvec3>> strokes_mm;
  std::vector<double> hops_mm;
  double sum = 0.0;
  for (std::size_t n = 0; n < cut.strokes_P_mm.size(); ++n) {
    const std::vector<glm::dvec3>& stroke = cut.strokes_P_mm[n];
    if (stroke.empty()) continue;
    strokes_mm.emplace_back();
    if (!cut.hop_mm.empty()) sum += hops_mm.emplace_back(n < cut.hop_mm.size() ? cut.hop_mm[n] : cut.over_mm);
    for (const glm::dvec3& p : stroke) {
      strokes_mm.back().push_back((X_DP * calibration::Point<calibration::Patient>{p}).mm);
      sum += glm::length(strokes_mm.back().back());
    }
  }
  const double area = glm::length(across);
  if (strokes_mm.empty() || !(std::isfinite(sum) && std::isfinite(area) && area > 1e-6))
    throw DeviceError("scripted hand, its site or directions are not usable, give finite ones that are not parallel");
  if (!std::isfinite(glm::length(motion.shaft_P)))
    throw DeviceError("scripted hand, its shaft direction is not finite, give one that is, or zero");
  if (!positive(cut.bur_radius_mm) || !positive(cut.over_mm) || !positive(motion.speed_mm_per_s) ||
      !positive(motion.travel_mm_per_s) || !positive(motion.approach_mm_per_s) || !positive(motion.clearance_mm))
    throw DeviceError("scripted hand, a size or speed of its plan is not positive, give positive ones");

  const glm::dvec3 outward = glm::normalize(outward_D), along = across / area;
  const glm::dvec3 buccal = glm::cross(along, outward), shaft_D = X_DP.rotation * motion.shaft_P;
  const double shaft_length = glm::length(shaft_D);
  const glm::dvec3 shaft =
      shaft_length > 0.0 ? shaft_D / shaft_length : std::cos(kTilt_rad) * outward + std::sin(kTilt_rad) * buccal;
  rotation_ = glm::normalize(glm::dquat(glm::dvec3(0.0, 0.0, 1.0), shaft));

  // In and out along the shaft, where it leads out of the bone.
  const double steep = glm::dot(shaft, outward);
  const glm::dvec3 away = shaft_length > 0.0 && steep > kLeastSteep ? shaft : outward;
  const double way_per_height = 1.0 / glm::dot(away, outward);

  // Over everything that is cut.
  double over_mm = -1e9;
  for (const auto& stroke : strokes_mm)
    for (const glm::dvec3& p : stroke) over_mm = std::max(over_mm, glm::dot(p, outward) + cut.over_mm);

  // From stroke to stroke half that way: along the shaft the bur would pass over the neighbour's crown.
  const glm::dvec3 half_way = glm::normalize(outward + away);
  const auto lifted = [&](const glm::dvec3& p, double to_mm) {
    return p + std::max(to_mm - glm::dot(p, outward), 0.0) / glm::dot(half_way, outward) * half_way;
  };
  begins_s_.push_back(0.0);
  corner_mm_.push_back(strokes_mm.front().front() + motion.clearance_mm * away);
  way_mm_.push_back(0.0);
  first_.push_back(1);
  go(strokes_mm.front().front(), motion.approach_mm_per_s);
  pedal_from_s_ = (1.0 - kPedalBefore) * begins_s_.back();
  for (std::size_t n = 0; n < strokes_mm.size(); ++n) {
    const std::vector<glm::dvec3>& stroke = strokes_mm[n];
    const glm::dvec3 from_mm = corner_mm_.back();
    if (glm::distance(from_mm, stroke.front()) > kMeets_mm) {
      const double higher_mm = std::max(glm::dot(from_mm, outward), glm::dot(stroke.front(), outward));
      const double hop_mm = hops_mm.empty() ? over_mm : std::min(over_mm, higher_mm + hops_mm[n]);
      go(lifted(from_mm, hop_mm), motion.travel_mm_per_s);
      go(lifted(stroke.front(), hop_mm), motion.travel_mm_per_s);
      go(stroke.front(), motion.travel_mm_per_s);
    } else if (corner_mm_.back() != stroke.front()) {
      go(stroke.front(), motion.speed_mm_per_s);
    }
    work(stroke, motion.speed_mm_per_s);
  }
  pedal_to_s_ = begins_s_.back();
  // Out of the gutter as between strokes, then to where the shaft leads.
  const glm::dvec3 end_mm = corner_mm_.back();
  go(lifted(end_mm, over_mm), motion.approach_mm_per_s);
  const double above_mm = glm::dot(strokes_mm.front().front() - end_mm, outward) + motion.clearance_mm;
  go(end_mm + std::max(above_mm, motion.clearance_mm) * way_per_height * away, motion.approach_mm_per_s);
}

void TroughPath::go(const glm::dvec3& to_mm, double speed_mm_per_s) {
  work({corner_mm_.back(), to_mm}, speed_mm_per_s);
}

/// A leg that begins where the one before it ends.
void TroughPath::work(const std::vector<glm::dvec3>& stroke_mm, double speed_mm_per_s) {
  double way_mm = 0.0;
  corner_mm_.push_back(stroke_mm.front());
  way_mm_.push_back(0.0);
  for (std::size_t n = 1; n < stroke_mm.size(); ++n) {
    way_mm += glm::distance(stroke_mm[n - 1], stroke_mm[n]);
    corner_mm_.push_back(stroke_mm[n]);
    way_mm_.push_back(way_mm);
  }
  first_.push_back(corner_mm_.size());
  begins_s_.push_back(begins_s_.back() + std::max(way_mm / speed_mm_per_s, kLeast_s));
}

HandTarget TroughPath::at(double t_s) const {
  const double t = std::clamp(t_s, 0.0, duration_s());
  const auto next = std::upper_bound(begins_s_.begin() + 1, begins_s_.end() - 1, t);
  const auto leg = static_cast<std::size_t>(next - begins_s_.begin()) - 1;

  // Eases in and out of each reversal.
  const double part = (t - begins_s_[leg]) / (begins_s_[leg + 1] - begins_s_[leg]);
  const std::size_t last = first_[leg + 1] - 1;
  const double way_mm = way_mm_[last] * (0.5 - 0.5 * std::cos(calibration::kPi * std::clamp(part, 0.0, 1.0)));
  const auto begin = way_mm_.begin() + static_cast<std::ptrdiff_t>(first_[leg]);
  const auto end = way_mm_.begin() + static_cast<std::ptrdiff_t>(last);
  const auto corner = static_cast<std::size_t>(std::lower_bound(begin, end, way_mm) - way_mm_.begin());
  glm::dvec3 position_mm = corner_mm_[corner];
  if (corner > first_[leg] && way_mm_[corner] > way_mm_[corner - 1])
    position_mm = glm::mix(corner_mm_[corner - 1], position_mm,
                           (way_mm - way_mm_[corner - 1]) / (way_mm_[corner] - way_mm_[corner - 1]));
  return {position_mm, rotation_, t_s > pedal_from_s_ && t_s < pedal_to_s_, 0, true};
}

}  // namespace haptics
