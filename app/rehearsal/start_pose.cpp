#include "app/rehearsal/start_pose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "calibration/geometry/units.h"

namespace app {
namespace {

constexpr double kFarthest_mm = 40.0, kStep_mm = 0.25, kBeyond_mm = 10.0;  // from the goal, towards the viewer
constexpr double kFarStep_mm = 2.0;                                        // where no bone is near
constexpr double kOnSite_mm = 1.0;
// Beside the goal, in the picture.
constexpr std::array kRings_mm{2.0, 4.0, 6.0, 8.0};
constexpr int kPlacesOnRing = 8;

struct Start {
  glm::dvec3 at_W_mm;
  glm::dvec3 nearest_P_mm;
};

/// From the viewer into the picture, until the bone is near enough.
std::optional<Start> startOnLine(const render::Frame& frame, const glm::dvec3& through_W_mm, const GapOf& gap_of) {
  render::Frame moved = frame;
  const auto X_PW = frame.rig.X_WP.inverse();
  for (double before_mm = kFarthest_mm; before_mm > -kBeyond_mm;) {
    const glm::dvec3 at_W_mm = through_W_mm + glm::dvec3(0.0, 0.0, before_mm);
    moved.X_PT.translation_mm = (X_PW * calibration::Point<calibration::World>{at_W_mm}).mm;
    const auto gap = gap_of(moved);
    if (gap && gap->mm <= kStartGap_mm)
      return Start{at_W_mm + glm::dvec3(0.0, 0.0, std::max(kStartGap_mm - gap->mm, 0.0)), gap->nearest_P.mm};
    // No way is shorter than the gap.
    before_mm -= gap ? std::max(gap->mm - kStartGap_mm, kStep_mm) : kFarStep_mm;
  }
  return {};
}

/// Of a place on the bone from what the bur sweeps.
double fromPlan_mm(const assets::PlannedCut& cut, const glm::dvec3& p_P_mm) {
  double nearest_mm = glm::distance(cut.surface_P_mm, p_P_mm);
  for (const auto& stroke : cut.strokes_P_mm)
    for (const glm::dvec3& at : stroke)
      nearest_mm = std::min(nearest_mm, std::max(glm::distance(at, p_P_mm) - cut.bur_radius_mm, 0.0));
  return nearest_mm;
}

}  // namespace

std::optional<glm::dvec3> startBeforeBone(const render::Frame& frame, const glm::dvec3& goal_P_mm,
                                          const GapOf& gap_of) {
  const glm::dvec3 goal_W_mm = (frame.rig.X_WP * calibration::Point<calibration::Patient>{goal_P_mm}).mm;
  const auto start = startOnLine(frame, goal_W_mm, gap_of);
  return start ? std::optional(start->at_W_mm) : std::nullopt;
}

std::optional<glm::dvec3> startBeforePlan(const render::Frame& frame, const assets::PlannedCut& cut,
                                          const GapOf& gap_of) {
  const glm::dvec3 goal_W_mm = (frame.rig.X_WP * calibration::Point<calibration::Patient>{cut.surface_P_mm}).mm;
  std::optional<glm::dvec3> best;
  double best_mm = std::numeric_limits<double>::max();
  const auto consider = [&](const glm::dvec3& beside_mm) {
    const auto start = startOnLine(frame, goal_W_mm + beside_mm, gap_of);
    if (!start) return;
    const double from_mm = fromPlan_mm(cut, start->nearest_P_mm);
    if (from_mm < best_mm) best_mm = from_mm, best = start->at_W_mm;
  };
  consider(glm::dvec3(0.0));
  for (const double ring_mm : kRings_mm) {
    if (best_mm <= kOnSite_mm) break;
    for (int n = 0; n < kPlacesOnRing; ++n) {
      const double angle = 2.0 * calibration::kPi * n / kPlacesOnRing;
      consider(ring_mm * glm::dvec3(std::cos(angle), std::sin(angle), 0.0));
    }
  }
  return best;
}

glm::dvec3 startOverCrown_P_mm(const assets::ToothCanals& tooth) {
  glm::dvec2 middle(0.0);
  for (const glm::dvec2& p : tooth.chamber.outline_mm)
    middle += p / static_cast<double>(tooth.chamber.outline_mm.size());
  double highest_mm = tooth.chamber.roof_mm;
  for (const assets::ToothCanal& canal : tooth.canals)
    highest_mm = std::max(highest_mm, tooth.frame.local(canal.reference_P_mm).z);
  return tooth.frame.inP({middle, highest_mm + kStartGap_mm});
}

glm::dvec3 startOverCrown_P_mm(const assets::PreparedTooth& tooth, const assets::CtVolume& ct) {
  constexpr double kFarOver_mm = 15.0, kStep_mm = 0.1;
  double height_mm = kFarOver_mm;
  while (height_mm > 0.0) {
    const glm::ivec3 ijk(glm::round(ct.grid.indexFromPoint(tooth.frame.inP({0.0, 0.0, height_mm}))));
    if (ct.grid.contains(ijk) && ct.solid[ct.grid.index(ijk)] >= assets::kHalfSolid) break;
    height_mm -= kStep_mm;
  }
  return tooth.frame.inP({0.0, 0.0, height_mm + kStartGap_mm});
}

}  // namespace app
