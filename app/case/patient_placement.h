// Pose of the patient at the display: the operating site at the centre of the virtual screen (rendering reference §5a:
// tracking errors cancel there), the surgeon's line of sight towards the viewer. Frames P and W, mm, 1:1. Pure;
// start-up only.
#pragma once

#include "assets/patient.h"
#include "assets/scenery/face_frame.h"
#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "calibration/rig.h"

namespace app {

/// X_WP with `site_P` at the origin of W, `eye_direction_P` (site to eye) along +z, and `up_P` in the half-plane of +y.
calibration::Pose<calibration::World, calibration::Patient> placePatient(
    const calibration::Point<calibration::Patient>& site_P,
    const calibration::Vector<calibration::Patient>& eye_direction_P,
    const calibration::Vector<calibration::Patient>& up_P);

/// With the operated tooth, or without one the middle of the jaw, at the origin of W, seen along the surgeon's line of
/// sight. `X_PF`: pose of the head around the jaw; a face with an open mouth is rotated against the scan.
calibration::Pose<calibration::World, calibration::Patient> placePatientAtSite(const assets::Patient& patient,
                                                                               const assets::FacePose& X_PF);

/// X_WP is the identity: the program chooses the pose.
bool hasNoPatientPose(const calibration::Rig& rig);

}  // namespace app
