// The webcam procedure at the workstation: what it asks is shown as a page, what the camera shall see as it is, one
// picture at a time; the stylus and its button lead through it, a long press takes the last tip again. Main thread.
// Esc, a closed window or an interrupt leaves, with nothing. Saves nothing.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "app/calibrate/webcam_procedure.h"
#include "app/calibrate/wizard_screen.h"
#include "calibration/synthetic/synthetic_rig.h"
#include "calibration/webcam/picture_source.h"
#include "haptics/device/haptic_device.h"

namespace app {

struct WebcamRun {
  WebcamPlan plan;
  haptics::HapticDevice* device = nullptr;            ///< opened, not started; null: practice
  calibration::PictureSource* pictures = nullptr;     ///< the webcam; null: a rendered one of the practice workstation
  std::optional<calibration::SyntheticRig> practice;  ///< what is practised on, where there is no device
  glm::ivec2 practice_px{1920, 1080};                 ///< of the rendered webcam
  bool robot = false;                                 ///< does all by itself, on the practice workstation
  bool windows = true;                                ///< false: nothing is shown; the robot's only
  WizardDisplay display;
  bool sounds = true;
  std::function<void(const std::string& line)> tell = [](const std::string&) {};
  std::function<bool()> given_up = [] { return false; };  ///< asked many times a second: an interrupt
};

/// None where somebody left. Throws as runWizard, and CalibrationError where the webcam falls silent.
std::optional<calibration::WebcamObservations> runWebcam(const WebcamRun& run);

}  // namespace app
