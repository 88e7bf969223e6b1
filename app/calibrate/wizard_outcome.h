// The result of a procedure: all measurements, and whether it was accepted. Until then the old calibration stays; the
// caller saves. Frame W, mm. Plain data; any thread.
#pragma once

#include <optional>
#include <string>

#include "app/calibrate/wizard_plan.h"
#include "calibration/fit/arm_fit.h"
#include "calibration/fit/rezero.h"
#include "calibration/webcam/flip_check.h"
#include "calibration/webcam/screen_size.h"

namespace app {

struct WizardOutcome {
  enum class End {
    running,
    accepted,
    declined,  ///< by the technician: the old calibration stays
    refused,   ///< by the program: `reason`
  };

  End end = End::running;
  std::string reason;  ///< one sentence, what to do with it

  std::optional<calibration::ImageOrientation> flip;  ///< how the drawn F read
  std::optional<calibration::MeasuredBars> bars;      ///< by a ruler
  std::optional<double> ipd_mm, eye_distance_mm;
  std::optional<calibration::ScreenCorners> screen;  ///< corrected by the bars; none: as it was

  calibration::TouchSet touches;       ///< of the calibration; empty: none was made
  calibration::TouchSet verification;  ///< held out, or of the last check
  calibration::TouchSet zeroing;       ///< of the re-zero
  calibration::TouchSet eye_check;
  std::optional<calibration::ArmFit> fit;
  std::optional<calibration::Rezero> rezero;
  std::optional<calibration::MeasuredArm> arm;  ///< the result; none: as before
  calibration::VerificationKind verification_kind = calibration::VerificationKind::full;
  std::vector<calibration::Residual> verification_residuals;
  std::optional<calibration::TargetErrors> errors;
  std::optional<calibration::Assessment> assessment;
  std::optional<calibration::RestRegistration> rest;
  double duration_s = 0.0;  ///< of the touches of calibration or re-zero
  int silences = 0;         ///< of the device, in between
};

/// The rig with what is known by now of screen and eyes.
calibration::Rig rigSoFar(const calibration::Rig& rig, const WizardOutcome& outcome);

/// The record with all accepted results. Times, versions, operator and parent are set by the caller that saves it.
/// As `before` unless it was accepted.
calibration::RigRecord recordOf(const WizardPlan& plan, const WizardOutcome& outcome);

}  // namespace app
