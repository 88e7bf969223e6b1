#include "app/rehearsal/start_pose.h"

#include <algorithm>

namespace app {
namespace {

constexpr double kFarthest_mm = 40.0, kStep_mm = 0.25, kBeyond_mm = 10.0;  // from the goal, towards the viewer

}  // namespace

std::optional<glm::dvec3> startBeforeBone(const render::Frame& frame, const glm::dvec3& goal_P_mm,
                                          const GapOf& gap_of) {
  const glm::dvec3 goal_W_mm = (frame.rig.X_WP * calibration::Point<calibration::Patient>{goal_P_mm}).mm;
  const auto X_PW = frame.rig.X_WP.inverse();
  render::Frame moved = frame;
  // From the viewer into the picture, until the bone is near enough.
  for (double before_mm = kFarthest_mm; before_mm > -kBeyond_mm; before_mm -= kStep_mm) {
    const glm::dvec3 at_W_mm = goal_W_mm + glm::dvec3(0.0, 0.0, before_mm);
    moved.X_PT.translation_mm = (X_PW * calibration::Point<calibration::World>{at_W_mm}).mm;
    if (const auto gap = gap_of(moved); gap && gap->mm <= kStartGap_mm)
      return at_W_mm + glm::dvec3(0.0, 0.0, std::max(kStartGap_mm - gap->mm, 0.0));
  }
  return {};
}

}  // namespace app
