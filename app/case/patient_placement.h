// Pose of the patient at the display: the operating site at the centre of the virtual screen (rendering reference §5a:
// tracking errors cancel there), the surgeon's line of sight towards the viewer. Frames P and W, mm, 1:1. Pure;
// start-up only.
#pragma once

#include <array>
#include <string_view>

#include "assets/patient.h"
#include "assets/scenery/face_frame.h"
#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "calibration/geometry/units.h"
#include "calibration/rig.h"

namespace app {

/// X_WP with `site_P` at the origin of W, `eye_direction_P` (site to eye) along +z, and `up_P` in the half-plane of +y.
calibration::Pose<calibration::World, calibration::Patient> placePatient(
    const calibration::Point<calibration::Patient>& site_P,
    const calibration::Vector<calibration::Patient>& eye_direction_P,
    const calibration::Vector<calibration::Patient>& up_P);

/// Where the surgeon works: in front of a seated patient, whose lower occlusal plane is level for lower teeth
/// (reference/product §2); or of a patient lying on the back, from the right (10 o'clock), the left (2 o'clock; advised
/// for lower molars, reference/calibration §5) or behind the head (12 o'clock). Named as --position.
enum class PatientPosition { seated, right, left, behind };
inline constexpr std::array<std::string_view, 4> kPatientPositions{"seated", "right", "left", "behind"};
/// `name`: one of kPatientPositions.
PatientPosition patientPositionNamed(std::string_view name);

/// How a lying head is turned (about its long axis, positive to its left) and tilted (positive: chin up) so that the
/// surgeon sees the tooth along the best line of sight. Turn at most 45°, tilt at most 30°: about two thirds and a half
/// of what healthy adults reach (75° and 60°, Youdas 1992, Phys. Ther. 72:770), held without strain.
struct HeadPose {
  double turn_rad = 0.0, tilt_rad = 0.0;
};
inline constexpr double kMaxHeadTurn_rad = calibration::radFromDegrees(45.0);
inline constexpr double kMaxHeadTilt_rad = calibration::radFromDegrees(30.0);
HeadPose headPose(PatientPosition position, int tooth_fdi);

/// With the operated tooth, or without one the middle of the jaw, at the origin of W, seen along the surgeon's line of
/// sight; from the other places the picture's up is away from the surgeon. `X_PF`: pose of the head around the jaw; a
/// face with an open mouth is rotated against the scan.
calibration::Pose<calibration::World, calibration::Patient> placePatientAtSite(const assets::Patient& patient,
                                                                               const assets::FacePose& X_PF,
                                                                               PatientPosition position = {});

/// Unit, along gravity in the room, of a patient who sits or lies so.
calibration::Vector<calibration::Patient> downInRoom(const assets::Patient& patient, const assets::FacePose& X_PF,
                                                     PatientPosition position = {});

/// X_WP is the identity: the program chooses the pose.
bool hasNoPatientPose(const calibration::Rig& rig);

}  // namespace app
