// Runs the webcam procedure at the workstation: instructions as pages, patterns for the camera full screen, one image
// at a time. The stylus button continues, a long press repeats the last tip. Main thread. Esc, a closed window or an
// interrupt leaves without result. Saves nothing.
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

/// None if the user left. Throws as runWizard, and CalibrationError if the webcam stops.
std::optional<calibration::WebcamObservations> runWebcam(const WebcamRun& run);

}  // namespace app
