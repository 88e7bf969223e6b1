#include "calibration/rig.h"

#include <cmath>

#include "calibration/arm/phantom_models.h"

namespace calibration {
namespace {

/// From the virtual screen to the mirror along the line of sight: case and hand fit under it.
constexpr double kMirrorAbove_mm = 200.0;

/// A published workstation with an Omni (reference/calibration 1.1).
constexpr double kDeviceTilt_deg = 41.61;
constexpr glm::dvec3 kDevicePlace_W_mm{0.0, -55.5, -36.0};

}  // namespace

Rig desktopRig(glm::ivec2 px, double width_mm, double eye_distance_mm) {
  const double x = 0.5 * width_mm, y = x * px.y / px.x;
  Rig rig;
  rig.screen = screenAround({}, {2.0 * x, 0.0, 0.0}, {0.0, 2.0 * y, 0.0}, px);
  rig.left_eye = {{-0.5 * kInterpupillary_mm, 0.0, eye_distance_mm}};
  rig.right_eye = {{0.5 * kInterpupillary_mm, 0.0, eye_distance_mm}};
  return rig;
}

Rig mirroredWorkstationRig(glm::ivec2 px, double width_mm, double eye_distance_mm) {
  Rig rig = desktopRig(px, width_mm, eye_distance_mm);
  const double half_right = std::sqrt(0.5);
  rig.mirror = Plane<World>{{0.0, half_right, half_right}, half_right * kMirrorAbove_mm};

  // The panel is tipped forward: its upper edge is nearer and appears as the lower one in the mirror.
  const double x = rig.screen.lower_right.mm.x, y = rig.screen.upper_left.mm.y;
  rig.screen.lower_left = rig.mirror->reflect({{-x, y, 0.0}});
  rig.screen.lower_right = rig.mirror->reflect({{x, y, 0.0}});
  rig.screen.upper_left = rig.mirror->reflect({{-x, -y, 0.0}});
  rig.X_WD = {glm::angleAxis(radFromDegrees(kDeviceTilt_deg), glm::dvec3(1.0, 0.0, 0.0)), kDevicePlace_W_mm};
  return rig;
}

std::optional<Rig> defaultRig(std::string_view name) {
  if (name == "mirrored") return mirroredWorkstationRig();
  if (name == "desktop") return desktopRig({1920, 1080});
  return std::nullopt;
}

std::optional<MeasuredArm> measuredArm(const Rig& rig) {
  if (!rig.device || !rig.arm) return std::nullopt;
  const PhantomModel* const model = findPhantomModel(rig.device->model);
  if (model == nullptr) return std::nullopt;
  return MeasuredArm{model->geometry, *rig.arm, rig.X_WD};
}

}  // namespace calibration
