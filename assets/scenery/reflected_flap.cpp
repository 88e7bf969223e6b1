#include "assets/scenery/reflected_flap.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "assets/smooth_distance.h"

namespace assets {
namespace {

constexpr double kGap_mm = 0.15;     // below the flap
constexpr double kInWound_mm = 0.2;  // by which the fold reaches over the wound's edge
constexpr double kRound_mm = 0.9;
constexpr double kFarCorner_mm = 20.0;  // from the middle of the cut to the wound's front corner, at most
constexpr double kIncision_mm = 7.5;    // length of the relieving incision
constexpr double kIncisionHalf_mm = 0.5;
constexpr double kCheekFrom_mm = 1.0;       // from the middle of the cut
constexpr double kBehindIncision_mm = 2.5;  // where the flap begins

}  // namespace

ReflectedFlap::ReflectedFlap(const PlannedCut& cut, const Wound& wound, GingivaDistance gingiva_mm)
    : wound_(wound),
      gingiva_mm_(std::move(gingiva_mm)),
      middle_P_mm_(middleOf_P_mm(cut)),
      buccal_P_(glm::normalize(cut.lateral_P)) {
  // Forwards along the arch: anterior is -y.
  const glm::dvec3 up = glm::normalize(cut.outward_P - glm::dot(cut.outward_P, buccal_P_) * buccal_P_);
  mesial_P_ = glm::cross(buccal_P_, up);
  if (mesial_P_.y > 0.0) mesial_P_ = -mesial_P_;

  // The wound's front corner on the cheek's side: from within, forwards until the edge; from there down and forwards.
  constexpr double kInside_mm = 3.0, kStep_mm = 0.25;
  corner_P_mm_ = middle_P_mm_ + kInside_mm * buccal_P_;
  for (double way_mm = 0.0; way_mm < kFarCorner_mm && wound.distance_mm(corner_P_mm_) < -0.3; way_mm += kStep_mm)
    corner_P_mm_ += kStep_mm * mesial_P_;
  along_P_ = glm::normalize(0.55 * mesial_P_ + 0.45 * buccal_P_ - 0.75 * up);
  across_P_ = glm::normalize(glm::cross(along_P_, buccal_P_));
  if (glm::dot(across_P_, mesial_P_) < 0.0) across_P_ = -across_P_;
}

// 0 on the tongue's side, 1 on the cheek's.
double ReflectedFlap::towardsCheek(const glm::dvec3& p_P_mm) const {
  return std::clamp((glm::dot(p_P_mm - middle_P_mm_, buccal_P_) - kCheekFrom_mm) / 3.0, 0.0, 1.0);
}

bool ReflectedFlap::isOnCheekSide(const glm::dvec3& p_P_mm) const {
  return glm::dot(p_P_mm - middle_P_mm_, buccal_P_) >= kCheekFrom_mm;
}

double ReflectedFlap::distance_mm(const glm::dvec3& p_P_mm) const {
  const double cheek = towardsCheek(p_P_mm);
  if (cheek <= 0.0) return kNone_mm;
  const double over_mm = wound_.distance_mm(p_P_mm);
  if (over_mm < -1.5 || over_mm > kFolded_mm + 3.0) return kNone_mm;
  const double above_mm = gingiva_mm_(p_P_mm);

  // A sheet on the surface from the fold to a free edge that is not quite straight; narrower towards its ends.
  const double along_mm = glm::dot(p_P_mm - middle_P_mm_, mesial_P_);
  const double uneven_mm = 0.35 * std::sin(0.9 * along_mm + 1.0) + 0.2 * std::sin(2.3 * along_mm);
  const double free_edge_mm = cheek * (kFolded_mm + uneven_mm);
  const double thick_mm = kFlapThickness_mm * (0.45 + 0.55 * cheek);
  // The retractor lifts its free edge off the gingiva.
  const double lifted = std::clamp(over_mm / kFolded_mm, 0.0, 1.0);
  const double low_mm = kGap_mm + kLift_mm * cheek * lifted * (2.0 - lifted);
  const double sheet_mm = std::abs(above_mm - low_mm - 0.5 * thick_mm) - 0.5 * thick_mm;
  const double to_edge_mm = smoothMax(over_mm - free_edge_mm, -kInWound_mm - over_mm, kRound_mm);
  const double front_mm = glm::dot(p_P_mm - corner_P_mm_, across_P_) + kBehindIncision_mm;
  return smoothMax(smoothMax(sheet_mm, to_edge_mm, kRound_mm), front_mm, kRound_mm);
}

double ReflectedFlap::incision_mm(const glm::dvec3& p_P_mm) const {
  if (!isOnCheekSide(p_P_mm)) return kNone_mm;
  // A wedge that narrows towards its end, through the whole gingiva.
  const double along_mm = glm::dot(p_P_mm - corner_P_mm_, along_P_);
  const double half_mm = kIncisionHalf_mm * std::clamp(1.0 - along_mm / kIncision_mm, 0.0, 1.0);
  return std::max(
      {std::abs(glm::dot(p_P_mm - corner_P_mm_, across_P_)) - half_mm, -2.0 - along_mm, along_mm - kIncision_mm});
}

}  // namespace assets
