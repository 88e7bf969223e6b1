// What a webcam procedure would measure at a synthetic workstation, without rendering: camera positions at the eye and
// to the left and right of it, the screen's pattern and the lit tip with the noise of detection, and intrinsics with a
// small error. Frames W and C; mm, px, rad. Pure functions of the generator; any thread but the servo's. webcam_image
// renders the same. Sizes: reference/calibration 2.3.
#pragma once

#include "calibration/arm/phantom_models.h"
#include "calibration/synthetic/synthetic_rig.h"
#include "calibration/webcam/webcam_observations.h"
#include "calibration/webcam/webcam_start.h"

namespace calibration {

struct WebcamCare {
  CameraModel camera;  ///< the truth
  double screen_noise_px = 0.25, tip_noise_px = 0.5;
  double focal_error = 0.001, centre_error_px = 1.0;  ///< of the intrinsics, one sigma
  double outlier_share = 0.02;                        ///< of tips detected 10 to 40 px off
};
/// Of 1920 x 1080 with tips found to 0.5 px, and of 1280 x 720 to 1 px.
WebcamCare fineWebcam();
WebcamCare coarseWebcam();

/// Three camera positions, the plan's positions touched again at each.
WebcamObservations syntheticObservations(const SyntheticRig& rig, const TargetPlan& plan, const WebcamCare& care,
                                         std::mt19937& rng);

/// The arm by a single camera position with the nominal model, to compare the bundle adjustment with.
inline MeasuredArm armFromOnePosition(const WebcamObservations& observations, std::size_t position) {
  const Pose<Camera, World> X_CW = cameraSeeing(observations, position);
  return {findPhantomModel(observations.device_model)->geometry, {}, deviceSeen(observations, position, X_CW)};
}

}  // namespace calibration
