// Initial camera and device poses from one camera position with the nominal arm, for a bundle adjustment. Frames W, C,
// D; mm, rad, px. Any thread but the servo's; about 10 ms. Source: OpenCV's solvePnP, IPPE (Collins, Bartoli 2014) for
// the screen, SQPNP (Terzakis, Lourakis 2020) for the tips; reference/calibration 3.3.
#pragma once

#include "calibration/calibration_error.h"
#include "calibration/fit/arm_parameters.h"
#include "calibration/webcam/webcam_observations.h"

namespace calibration {

/// From the screen. Throws CalibrationError: seen from behind (mirrored), or no pose explains it.
Pose<Camera, World> cameraSeeing(const WebcamObservations& observations, std::size_t position);

/// From the tips, without outliers. Throws CalibrationError: fewer than two thirds agree.
Pose<World, Device> deviceSeen(const WebcamObservations& observations, std::size_t position,
                               const Pose<Camera, World>& X_CW);

}  // namespace calibration
