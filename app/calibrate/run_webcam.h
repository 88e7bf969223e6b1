// The webcam procedure at the workstation: what it asks is shown as a page, what the camera shall see as it is, one
// image at a time; the stylus and its button lead through it, a long press takes the last tip again. Main thread.
// Esc, a closed window or an interrupt leaves, with nothing. Saves nothing.
#pragma once

#include <optional>

#include "app/calibrate/guided_procedure.h"
#include "app/calibrate/webcam_procedure.h"
#include "calibration/webcam/image_source.h"

namespace app {

struct WebcamRun : GuidedRun {
  WebcamPlan plan;
  calibration::ImageSource* images = nullptr;  ///< the webcam; null: a rendered one of the practice workstation
  glm::ivec2 practice_px{1920, 1080};          ///< of the rendered webcam
  bool robot = false;                          ///< does all by itself, on the practice workstation
};

/// None where somebody left. Throws as runWizard, and CalibrationError where the webcam falls silent.
std::optional<calibration::WebcamObservations> runWebcam(const WebcamRun& run);

}  // namespace app
