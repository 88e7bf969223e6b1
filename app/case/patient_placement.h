// How the patient stands at the display: the operating site at the centre of the virtual screen (rendering reference
// §5a: there, tracking errors cancel), the surgeon's line of sight towards the viewer. Frames P and W, mm, 1:1.
// Pure; start-up only.
#pragma once

#include "assets/patient.h"
#include "assets/scenery/face_frame.h"
#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "calibration/rig.h"

namespace app {

/// X_WP with `site_P` at the origin of W, `eye_direction_P` (site to eye) along +z and `up_P` as upright as that
/// allows.
calibration::Pose<calibration::World, calibration::Patient> placePatient(
    const calibration::Point<calibration::Patient>& site_P,
    const calibration::Vector<calibration::Patient>& eye_direction_P,
    const calibration::Vector<calibration::Patient>& up_P);

/// The tooth at the site at the origin of W, or where to look without one, every head looked into along the surgeon's
/// line. `X_PF`: how the head stands around the jaw; a placed face opens its mouth, which turns it against the scan.
calibration::Pose<calibration::World, calibration::Patient> placePatientAtSite(const assets::Patient& patient,
                                                                               const assets::FacePose& X_PF);

/// Whether a rig leaves it to the program how the patient stands: X_WP is the identity.
bool hasNoPatientPose(const calibration::Rig& rig);

}  // namespace app
