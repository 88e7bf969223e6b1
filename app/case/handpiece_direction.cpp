#include "app/case/handpiece_direction.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "assets/cut_field.h"
#include "calibration/geometry/units.h"
#include "haptics/tool/instrument_outline.h"

namespace app {
namespace {

constexpr std::size_t kPlaces = 48;           // of the cut at which the outline is laid
constexpr int kEdges = 8;                     // sides of the cut whose outermost place counts as well
constexpr double kOver_mm = 2.0;              // above all places, on the way from stroke to stroke
constexpr double kLeastOutward = 0.2;         // cosine of the angle to the way out of the bone
constexpr int kDirections = 2000;             // on the whole sphere
constexpr double kCloser = 0.035;             // 2 degrees, between directions around the best
constexpr double kFreeOfSoftTissue_mm = 1.0;  // no better with more
// The rest in mm of room at soft tissue that they are worth.
constexpr double kInBone_mm = 12.0;  // at every place
constexpr double kPerDegreeFromWayIn_mm = 0.1;
// The handpiece hides what lies within 6 degrees around its axis, the eyes stand 4 degrees beside the line of sight.
constexpr double kHides_deg = 20.0, kPerDegreeHidden_mm = 0.2;

double angle_deg(const glm::dvec3& a, const glm::dvec3& b) {
  return calibration::degreesFromRad(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

/// Two directions square to a direction and to each other.
std::pair<glm::dvec3, glm::dvec3> besides(const glm::dvec3& direction_P) {
  const glm::dvec3 aside = glm::normalize(
      glm::cross(direction_P, std::abs(direction_P.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
  return {aside, glm::cross(direction_P, aside)};
}

/// Places all over the cut and at its edges, the outline of the tool and the bone that stays.
class Mouth {
 public:
  Mouth(const assets::PlannedCut& cut, const assets::CtVolume& ct, const assets::SoftTissueField& soft,
        const haptics::Tool& tool)
      : ct_(ct), soft_(soft), removed_(cut, 1.0), outline_(haptics::outlineOf(haptics::sanitised(tool))) {
    std::vector<glm::dvec3> all;
    for (const auto& stroke : cut.strokes_P_mm) all.insert(all.end(), stroke.begin(), stroke.end());
    const std::size_t count = std::min(all.size(), kPlaces);
    for (std::size_t n = 0; n < count; ++n) places_P_mm_.push_back(all[n * all.size() / count]);
    const double out_length = glm::length(cut.outward_P);
    if (all.empty() || !(out_length > 0.0)) return;

    // The edges, and how high above them the bur goes from stroke to stroke.
    outward_ = cut.outward_P / out_length;
    const auto [aside, across] = besides(outward_);
    for (const glm::dvec3& p : all) over_mm_ = std::max(over_mm_, glm::dot(p, outward_) + kOver_mm);
    for (int n = 0; n < kEdges; ++n) {
      const double turn_rad = 2.0 * calibration::kPi * n / kEdges;
      const glm::dvec3 side = std::cos(turn_rad) * aside + std::sin(turn_rad) * across;
      edges_P_mm_.push_back(*std::ranges::max_element(all, {}, [&](const glm::dvec3& p) { return glm::dot(p, side); }));
    }
  }

  bool isEmpty() const { return places_P_mm_.empty(); }

  HandpieceRoom room(const glm::dvec3& direction_P) const {
    HandpieceRoom room{assets::SoftTissueField::kOutside_mm, 0.0};
    const auto [aside, across] = besides(direction_P);
    int in_bone = 0;
    for (const glm::dvec3& place : places_P_mm_) {
      bool meets_bone = false;
      for (std::size_t n = outline_.head_count; n < outline_.count; ++n) {
        const glm::dvec3 centre = place + outline_.balls[n].z_mm * direction_P;
        const double radius_mm = outline_.balls[n].radius_mm;
        room.soft_mm = std::min(room.soft_mm, softRoom_mm(centre, radius_mm));
        if (meets_bone || outline_.balls[n].z_mm > kBoneWithin_mm) continue;
        for (const glm::dvec3& side : {glm::dvec3(0.0), aside, -aside, across, -across})
          meets_bone = meets_bone || isInBone(centre + radius_mm * side);
      }
      in_bone += meets_bone;
    }
    // Half way between shaft and way out, as scripted hands lift the bur.
    const glm::dvec3 lift = glm::normalize(outward_ + direction_P);
    const double per_height = 1.0 / std::max(glm::dot(lift, outward_), kLeastOutward);
    for (const glm::dvec3& edge : edges_P_mm_) {
      const glm::dvec3 over = edge + (over_mm_ - glm::dot(edge, outward_)) * per_height * lift;
      for (std::size_t n = outline_.head_count; n < outline_.count; ++n)
        for (const glm::dvec3& place : {edge, over})
          room.soft_mm = std::min(
              room.soft_mm, softRoom_mm(place + outline_.balls[n].z_mm * direction_P, outline_.balls[n].radius_mm));
    }
    room.in_bone_share = in_bone / static_cast<double>(std::max<std::size_t>(places_P_mm_.size(), 1));
    return room;
  }

 private:
  static constexpr double kBoneWithin_mm = 25.0;  ///< of the bur; farther up is the handpiece, wider than the mouth

  double softRoom_mm(const glm::dvec3& centre_P_mm, double radius_mm) const {
    return soft_.at(centre_P_mm).distance_mm - radius_mm;
  }

  bool isInBone(const glm::dvec3& p_P_mm) const {
    const glm::ivec3 ijk(glm::round(ct_.grid.indexFromPoint(p_P_mm)));
    return ct_.grid.contains(ijk) && ct_.solid[ct_.grid.index(ijk)] >= assets::kHalfSolid && !removed_.contains(p_P_mm);
  }

  const assets::CtVolume& ct_;
  const assets::SoftTissueField& soft_;
  assets::CutField removed_;
  haptics::InstrumentOutline outline_;
  std::vector<glm::dvec3> places_P_mm_, edges_P_mm_;
  glm::dvec3 outward_{0.0};
  double over_mm_ = -1e9;  ///< along outward_
};

}  // namespace

HandpieceRoom handpieceRoom(const assets::PlannedCut& cut, const assets::CtVolume& ct,
                            const assets::SoftTissueField& soft, const haptics::Tool& tool,
                            const glm::dvec3& direction_P) {
  return Mouth(cut, ct, soft, tool).room(glm::normalize(direction_P));
}

glm::dvec3 handpieceDirection_P(const assets::PlannedCut& cut, const assets::CtVolume& ct,
                                const assets::SoftTissueField& soft, const haptics::Tool& tool) {
  const Mouth mouth(cut, ct, soft, tool);
  const double out_length = glm::length(cut.outward_P), sight_length = glm::length(cut.sight_P);
  if (mouth.isEmpty() || !(out_length > 0.0)) return glm::dvec3(0.0);
  const glm::dvec3 outward = cut.outward_P / out_length;

  struct Choice {
    glm::dvec3 direction_P{0.0};
    double cost_mm = 1e9;
  };
  // Its angles alone, which cost less time than what it meets.
  const auto angles_mm = [&](const glm::dvec3& direction) {
    double cost_mm = kPerDegreeFromWayIn_mm * angle_deg(direction, outward);
    if (sight_length > 0.0)
      cost_mm += kPerDegreeHidden_mm * std::max(0.0, kHides_deg - angle_deg(direction, cut.sight_P));
    return cost_mm;
  };
  Choice best;
  const auto keep_better = [&](const glm::dvec3& direction) {
    if (glm::dot(direction, outward) < kLeastOutward) return;
    double cost_mm = angles_mm(direction);
    if (cost_mm >= best.cost_mm) return;
    const HandpieceRoom room = mouth.room(direction);
    cost_mm += std::max(0.0, kFreeOfSoftTissue_mm - room.soft_mm) + kInBone_mm * room.in_bone_share;
    if (cost_mm < best.cost_mm) best = {direction, cost_mm};
  };
  // A Fibonacci lattice, then rings around the best of it.
  const double golden_rad = calibration::kPi * (3.0 - std::sqrt(5.0));
  for (int n = 0; n < kDirections; ++n) {
    const double z = 1.0 - (2.0 * n + 1.0) / kDirections, side = std::sqrt(1.0 - z * z);
    keep_better({side * std::cos(n * golden_rad), side * std::sin(n * golden_rad), z});
  }
  const glm::dvec3 middle = best.direction_P;
  const glm::dvec3 aside = glm::normalize(glm::cross(middle, outward + glm::dvec3(1e-3, 2e-3, 3e-3)));
  const glm::dvec3 across = glm::cross(middle, aside);
  for (int i = -2; i <= 2; ++i)
    for (int j = -2; j <= 2; ++j)
      keep_better(glm::normalize(middle + kCloser * (double(i) * aside + double(j) * across)));
  return best.direction_P;
}

}  // namespace app
