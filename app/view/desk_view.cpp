#include "app/view/desk_view.h"

#include <algorithm>
#include <cmath>

#include "calibration/geometry/units.h"

namespace app {
namespace {

constexpr double kTurn_rad_per_px = calibration::radFromDegrees(0.15);
constexpr double kMostPitch_rad = calibration::radFromDegrees(85.0);
/// A mouth opened for work leaves some ten degrees about the line of sight (app/case/handpiece_direction.h).
constexpr double kFree_rad = calibration::radFromDegrees(5.0), kWideOpen_rad = calibration::radFromDegrees(25.0);
constexpr double kFaceWindow_mm = 13.0;
const double kMagnifyingStep = std::pow(2.0, 0.25);

}  // namespace

void DeskView::turn(const glm::dvec2& by_px) {
  yaw_rad_ = std::remainder(yaw_rad_ + kTurn_rad_per_px * by_px.x, 2.0 * calibration::kPi);
  pitch_rad_ = std::clamp(pitch_rad_ + kTurn_rad_per_px * by_px.y, -kMostPitch_rad, kMostPitch_rad);
}

void DeskView::magnify(int steps) {
  magnified_ = std::clamp(magnified_ * std::pow(kMagnifyingStep, steps), kLeastMagnified, kMostMagnified);
}

glm::dquat DeskView::rotation() const {
  return glm::angleAxis(pitch_rad_, glm::dvec3(1.0, 0.0, 0.0)) * glm::angleAxis(yaw_rad_, glm::dvec3(0.0, 1.0, 0.0));
}

double DeskView::faceWindow_mm() const {
  const double turned_rad = std::acos(std::clamp((rotation() * glm::dvec3(0.0, 0.0, 1.0)).z, -1.0, 1.0));
  return kFaceWindow_mm * std::clamp((turned_rad - kFree_rad) / (kWideOpen_rad - kFree_rad), 0.0, 1.0);
}

calibration::Rig DeskView::rig() const {
  calibration::Rig rig = first_;
  const calibration::Pose<calibration::World, calibration::World> turned{rotation(),
                                                                         site_W_.mm - rotation() * site_W_.mm};
  rig.X_WP = turned * first_.X_WP;
  // Stronger loupes: the same pixels show a smaller part of the virtual screen.
  const calibration::ScreenCorners& screen = first_.screen;
  rig.screen = calibration::screenAround(screen.centre_mm(), screen.across_mm() / magnified_,
                                         screen.up_mm() / magnified_, screen.px);
  return rig;
}

}  // namespace app
