// The measured rig in W: panel, mirror, eyes, patient, device, and the correction of the device's arm. mm. Plain data;
// any thread. rig_file reads and writes it; eye projection (render) and the haptic loop use it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "calibration/arm/arm_correction.h"
#include "calibration/geometry/frames.h"
#include "calibration/geometry/plane.h"
#include "calibration/geometry/pose.h"

namespace calibration {

/// Corners of the framebuffer image on the physical panel, in W, and its size.
struct ScreenCorners {
  glm::ivec2 px{1920, 1080};
  Point<World> lower_left, lower_right, upper_left;

  glm::dvec3 across_mm() const { return lower_right.mm - lower_left.mm; }
  glm::dvec3 up_mm() const { return upper_left.mm - lower_left.mm; }
  glm::dvec3 centre_mm() const { return 0.5 * (lower_right.mm + upper_left.mm); }
};

inline ScreenCorners screenAround(const glm::dvec3& centre_mm, const glm::dvec3& across_mm, const glm::dvec3& up_mm,
                                  const glm::ivec2& px) {
  return {px,
          {centre_mm - 0.5 * (across_mm + up_mm)},
          {centre_mm + 0.5 * (across_mm - up_mm)},
          {centre_mm - 0.5 * (across_mm - up_mm)}};
}

/// The device a rig was measured with; the rig is not valid for another.
struct RigDevice {
  std::string model;  ///< key of phantom_models
  std::string serial;
  std::string mount;       ///< "right" or "left" of the surgeon
  std::string stylus_tip;  ///< bur or stylus end in the handle
};

struct Rig {
  ScreenCorners screen;
  std::optional<Plane<World>> mirror;
  Point<World> left_eye, right_eye;
  Pose<World, Patient> X_WP;
  Pose<World, Device> X_WD;
  std::optional<Pose<World, Device>> second_X_WD;  ///< of the second hand's device, if measured
  std::optional<RigDevice> device;                 ///< none: not measured with a device
  std::optional<ArmCorrection> arm;                ///< of that device; none: nominal

  Point<World> cyclopeanEye() const { return {0.5 * (left_eye.mm + right_eye.mm)}; }
};

/// The screen as the surgeon sees it: the panel's corners reflected in the mirror, if any. The mirror flip is in these
/// corners and nowhere else.
inline ScreenCorners virtualScreen(const Rig& rig) {
  ScreenCorners seen = rig.screen;
  if (rig.mirror)
    for (Point<World>* const corner : {&seen.lower_left, &seen.lower_right, &seen.upper_left})
      *corner = rig.mirror->reflect(*corner);
  return seen;
}

/// Pupillary distance of an average adult (rendering reference 5a).
inline constexpr double kInterpupillary_mm = 63.0;

/// Image width of a 24-inch 16:9 monitor.
inline constexpr double kDeskMonitorWidth_mm = 531.0;

/// A monitor without mirror, centred at the origin of W, `width_mm` wide with square pixels, eyes `eye_distance_mm` in
/// front of it. X_WP and X_WD are identity.
Rig desktopRig(glm::ivec2 px, double width_mm = kDeskMonitorWidth_mm, double eye_distance_mm = 500.0);

/// Before any measurement: a monitor tipped forward over the hand, seen in a 45 degree mirror. The virtual screen
/// stands upright about the origin of W, the mirror between it and the eyes, panel and mirror above the work, the
/// device behind and below (X_WD: reference/calibration 1.1, 5). X_WP is identity.
Rig mirroredWorkstationRig(glm::ivec2 px = {1920, 1080}, double width_mm = kDeskMonitorWidth_mm,
                           double eye_distance_mm = 450.0);

/// Built-in rigs: "mirrored" (45 degree mirror, panel above) and "desktop" (monitor without mirror). None: another
/// name.
std::optional<Rig> defaultRig(std::string_view name);

/// The calibrated arm of the rig's device. None: not measured, or an unknown model.
std::optional<MeasuredArm> measuredArm(const Rig& rig);

}  // namespace calibration
