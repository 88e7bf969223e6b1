// The measured rig: where the panel, the mirror, the eyes, the patient and the device are, in frame W (mm), and how the
// device's arm differs from its model. Plain data; any thread. rig_file reads and writes it; eye projection (render)
// and the haptic loop use it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "calibration/arm/arm_correction.h"
#include "calibration/geometry/frames.h"
#include "calibration/geometry/plane.h"
#include "calibration/geometry/pose.h"

namespace calibration {

/// Corners of the framebuffer image on the physical panel, in W, and its size in px.
struct ScreenCorners {
  glm::ivec2 px{1920, 1080};
  Point<World> lower_left, lower_right, upper_left;
};

/// Which device a rig was measured with. A rig says nothing of another.
struct RigDevice {
  std::string model;  ///< key of phantom_models
  std::string serial;
  std::string mount;       ///< "right" or "left": on which side of the surgeon it stands
  std::string stylus_tip;  ///< which bur or stylus end was in its handle
};

struct Rig {
  ScreenCorners screen;
  std::optional<Plane<World>> mirror;
  Point<World> left_eye, right_eye;
  Pose<World, Patient> X_WP;
  Pose<World, Device> X_WD;
  std::optional<Pose<World, Device>> second_X_WD;  ///< of the other hand's device, where it was measured
  std::optional<RigDevice> device;                 ///< none: never measured with a device
  std::optional<ArmCorrection> arm;                ///< of that device; none: as its model

  Point<World> cyclopeanEye() const { return {0.5 * (left_eye.mm + right_eye.mm)}; }
};

/// Distance between the pupils of an average adult (rendering reference §5a), mm.
inline constexpr double kInterpupillary_mm = 63.0;

/// Width of the image of a 24-inch monitor, 16:9, mm.
inline constexpr double kDeskMonitorWidth_mm = 531.0;

/// A monitor on the desk, without mirror: its centre is the origin of W, `width_mm` wide, as high as the pixels ask,
/// eyes `eye_distance_mm` in front of it. X_WP and X_WD are identity.
Rig desktopRig(glm::ivec2 px, double width_mm = kDeskMonitorWidth_mm, double eye_distance_mm = 500.0);

/// A monitor tipped forward over the hand, its image seen in a mirror at 45 degrees, before anything is measured:
/// the virtual screen stands upright about the origin of W, the mirror between it and the eyes, panel and mirror above
/// the work. The device stands behind and below (X_WD: reference/calibration 1.1, 5). X_WP is identity.
Rig mirroredWorkstationRig(glm::ivec2 px = {1920, 1080}, double width_mm = kDeskMonitorWidth_mm,
                           double eye_distance_mm = 450.0);

/// The rigs that come with the program. "mirrored": a 45 degree mirror over the hand, panel above it · "desktop": a
/// monitor without mirror. None for another name.
std::optional<Rig> defaultRig(std::string_view name);

/// The arm of the rig's device as it stands: null where the rig has none, or a model that is not known.
std::optional<MeasuredArm> measuredArm(const Rig& rig);

}  // namespace calibration
