// From touches to a measured arm: where the device stands (X_WD) and how its arm differs from its model, as the most
// probable values under priors of what such units are like. Outliers are found and named first. Models from few
// parameters to many: rigid 6, joint gains and offsets with the tip 15, full 28; affine 12 for comparison alone, for
// the workstation is 1:1. Frame W, mm, rad. Any thread but the servo's; about 10 ms for 27 touches, cross-validation of
// all models included. Sources: reference/calibration 2.1, 3.1, 4.1.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibration/calibration_error.h"
#include "calibration/fit/arm_parameters.h"
#include "calibration/fit/fit_warnings.h"
#include "calibration/fit/touches.h"

namespace calibration {

std::string_view nameOf(ArmModel model);  ///< "rigid", "joints", "full": in rig files too
std::optional<ArmModel> armModelNamed(std::string_view name);

/// One model, how well it foretells touches it has not seen.
struct ModelScore {
  std::string name;         ///< also "affine"
  int parameters = 0;       ///< fitted
  double fre_rms_mm = 0.0;  ///< on the touches it was fitted to: plausibility, no accuracy
  double cv_rms_mm = 0.0;   ///< of touches left out: 5-fold, below 20 places each place in turn
};

/// What is left at a touch: where the arm says its tip was, less where it was.
struct Residual {
  int id = 0;
  Point<World> target_W;
  Vector<World> error_mm;
  bool used = true;  ///< false: an outlier, or set aside
};

struct ArmFit {
  ArmModel model = ArmModel::full;
  MeasuredArm arm;
  std::vector<ModelScore> scores;   ///< of every model that was tried, affine too
  std::vector<Residual> residuals;  ///< of every touch, in their order
  std::vector<FitWarning> warnings;
  int used = 0, outliers = 0;
  double fre_rms_mm = 0.0, cv_rms_mm = 0.0;
  double expected_fre_mm = 0.0;  ///< from the touches' precision and the parameters fitted
  Vector<World> bias_mm;         ///< mean of the residuals of the touches used
  double tilt_spread_deg = 0.0;  ///< how differently the stylus was held (touch_checks)
  double mismatch_mm = 0.0;      ///< one sigma, an axis: what the model can not explain beyond the touches' precision
  double hull_mm3 = 0.0;         ///< of the convex hull of the targets used
  int iterations = 0;
  std::vector<double> sigma;  ///< in the order of kArmParameters: 1 sigma of each number fitted, 0 of the others
};

struct FitOptions {
  std::optional<ArmModel> model;  ///< none: by cross-validation; simpler preferred within 10 % of mean square
  double region_mm3 = 0.0;        ///< volume of the case's region; 0: not known. Less than 60 % of it is warned of
};

/// Throws CalibrationError for fewer than 4 touches, all on a line or in one place, the same touch twice, parameters
/// that are not finite, an unknown model, touches that are mirrored (a flip of the display is wrong), or that no pose
/// of the arm explains (wrong order, wrong device). A full model is chosen by itself from 8 touches whose tilts vary.
ArmFit fitArm(const TouchSet& touches, const FitOptions& options = {});

/// Of a touch set against an arm that is already there.
std::vector<Residual> residualsOf(const MeasuredArm& arm, const std::vector<Touch>& touches);

}  // namespace calibration
