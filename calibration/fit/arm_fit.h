// Fits a measured arm to touches: pose of the device (X_WD) and correction of the arm, as the maximum a posteriori
// estimate under priors for such units, after outlier rejection. Models: rigid 6, joint gains and offsets with the tip
// 15, full 28 parameters; affine 12 for comparison only, as the workstation is 1:1. Frame W, mm, rad. Any thread but
// the servo's; about 10 ms for 27 touches with cross-validation of all models. Sources: reference/calibration 2.1, 3.1,
// 4.1.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibration/calibration_error.h"
#include "calibration/fit/arm_parameters.h"
#include "calibration/fit/fit_warnings.h"
#include "calibration/fit/touches.h"

namespace calibration {

std::string_view nameOf(ArmModel model);  ///< "rigid", "joints", "full"; also in rig files
std::optional<ArmModel> armModelNamed(std::string_view name);

/// How well one model predicts touches it was not fitted to.
struct ModelScore {
  std::string name;         ///< also "affine"
  int parameters = 0;       ///< fitted
  double fre_rms_mm = 0.0;  ///< on the fitted touches: plausibility, not accuracy
  double cv_rms_mm = 0.0;   ///< on touches left out: 5-fold, below 20 positions each position in turn
};

/// At a touch: tip by the arm minus target.
struct Residual {
  int id = 0;
  Point<World> target_W;
  Vector<World> error_mm;
  bool used = true;  ///< false: an outlier, or set aside
};

struct ArmFit {
  ArmModel model = ArmModel::full;
  MeasuredArm arm;
  std::vector<ModelScore> scores;   ///< of every model tried, affine included
  std::vector<Residual> residuals;  ///< of every touch, in order
  std::vector<FitWarning> warnings;
  int used = 0, outliers = 0;
  double fre_rms_mm = 0.0, cv_rms_mm = 0.0;
  double expected_fre_mm = 0.0;  ///< from the touches' precision and the number of parameters
  Vector<World> bias_mm;         ///< mean residual of the touches used
  double tilt_spread_deg = 0.0;  ///< variety of the stylus directions (touch_checks)
  double mismatch_mm = 0.0;      ///< one sigma, an axis: model error beyond the touches' precision
  double hull_mm3 = 0.0;         ///< of the targets used
  int iterations = 0;
  std::vector<double> sigma;  ///< in the order of ArmParameters: 1 sigma of the fitted ones, 0 of the others
};

struct FitOptions {
  std::optional<ArmModel> model;  ///< none: by cross-validation; the simpler within 10 % of mean square
  double region_mm3 = 0.0;        ///< volume of the case's region, 0: not known; less than 60 % of it gives a warning
};

/// Throws CalibrationError for fewer than 4 touches, all on a line or at one position, the same touch twice, numbers
/// not finite, an unknown model, mirrored touches (flipped display), or touches that no pose of the arm explains (wrong
/// order, wrong device). The full model can be selected from 8 touches with varied tilts.
ArmFit fitArm(const TouchSet& touches, const FitOptions& options = {});

std::vector<Residual> residualsOf(const MeasuredArm& arm, const std::vector<Touch>& touches);

}  // namespace calibration
