// What a webcam procedure would have measured at a workstation whose truth is known, without drawing any image: the
// camera put near the eye, then to the left and to the right of it, the screen's pattern and the lit tip where they
// fall, with the noise that finding them has. The camera's own numbers are believed to be a little other than they are.
// Frames W and C; mm, px, rad. Pure functions of the generator; any thread but the servo's. webcam_picture draws what
// is found here. Sizes: reference/calibration 2.3.
#pragma once

#include "calibration/synthetic/synthetic_rig.h"
#include "calibration/webcam/webcam_fit.h"

namespace calibration {

struct WebcamCare {
  CameraModel camera;  ///< the truth
  double screen_noise_px = 0.25, tip_noise_px = 0.5;
  double focal_error = 0.001, centre_error_px = 1.0;  ///< of the intrinsics, one sigma
  double outlier_share = 0.02;                        ///< of tips that are taken for something 10 to 40 px beside
};
/// Of 1920 x 1080 with tips found to 0.5 px, and of 1280 x 720 to 1 px.
WebcamCare fineWebcam();
WebcamCare coarseWebcam();

/// Three camera positions, the plan's places touched anew at each.
WebcamObservations syntheticObservations(const SyntheticRig& rig, const TargetPlan& plan, const WebcamCare& care,
                                         std::mt19937& rng);

}  // namespace calibration
