// From touches to a measured arm: where the device stands (X_WD) and how its arm differs from its model, as the most
// probable values under priors of what such units are like. Outliers are found and named first. Models from few numbers
// to many: rigid 6, joint gains and offsets with the tip 15, full 28; affine 12 for comparison alone, for the
// workstation is 1:1. Frame W, mm, rad. Any thread but the servo's; at most 1 s.
// Sources: reference/calibration 2.1, 3.1, 4.1; Umeyama 1991; Fitzpatrick, West, Maurer, IEEE TMI 1998.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibration/calibration_error.h"
#include "calibration/fit/arm_numbers.h"
#include "calibration/fit/touches.h"

namespace calibration {

std::string_view nameOf(ArmModel model);  ///< "rigid", "joints", "full"
std::optional<ArmModel> armModelNamed(std::string_view name);

/// One model, how well it foretells touches it has not seen.
struct ModelScore {
  std::string name;         ///< also "affine"
  int numbers = 0;          ///< fitted
  double fre_rms_mm = 0.0;  ///< on the touches it was fitted to: plausibility, no accuracy
  double cv_rms_mm = 0.0;   ///< 5-fold
};

/// What is left at a touch: where the arm says its tip was, less where it was.
struct Residual {
  int id = 0;
  Point<World> target_W;
  Vector<World> error_mm;
  bool used = true;  ///< false: an outlier, or set aside
};

/// Something that makes the result less than it seems.
struct FitWarning {
  enum class Kind { few_touches, small_volume, little_tilt, optimistic_check, many_outliers, mirrored, over_fitted };
  Kind kind;
  std::string line;  ///< for people: what, and what to do
};

struct ArmFit {
  ArmModel model = ArmModel::full;
  MeasuredArm arm;
  std::vector<ModelScore> scores;   ///< of every model that was tried, affine too
  std::vector<Residual> residuals;  ///< of every touch, in their order
  std::vector<FitWarning> warnings;
  int used = 0, outliers = 0;
  double fre_rms_mm = 0.0, cv_rms_mm = 0.0;
  double expected_fre_mm = 0.0;  ///< from the touches' precision and the numbers fitted
  Vector<World> bias_mm;         ///< mean of the residuals of the touches used
  double tilt_spread_deg = 0.0;  ///< between the stylus's directions, 95 of 100 pairs are within it
  double hull_mm3 = 0.0;         ///< of the convex hull of the targets used
  int iterations = 0;
  /// Row-major, in the order of kArmParameters: 1 sigma of each number that was fitted, 0 of the others.
  std::vector<double> sigma;
};

struct FitOptions {
  std::optional<ArmModel> model;  ///< none: chosen by cross-validation, a simpler one preferred within 10 %
  double region_mm3 = 0.0;        ///< volume of the case's region; 0: not known. Less than 60 % of it is warned of
};

/// Throws CalibrationError for fewer than 4 touches, all on a line or in one place, the same touch twice, numbers that
/// are not finite, an unknown model, or touches that no pose of the arm explains (wrong order, wrong device).
ArmFit fitArm(const TouchSet& touches, const FitOptions& options = {});

/// Of a touch set against an arm that is already there.
std::vector<Residual> residualsOf(const MeasuredArm& arm, const std::vector<Touch>& touches);

/// Where the tip's error is expected, at a place, after a rigid fit of these touches (Fitzpatrick 1998, eq. 46):
/// TRE^2 = FLE^2 / N (1 + 1/3 sum_k d_k^2 / f_k^2). `fle_mm`: of one touch.
class ExpectedErrorMap {
 public:
  ExpectedErrorMap(const std::vector<Point<World>>& targets_W, double fle_mm);
  double at_mm(const Point<World>& place_W) const;

 private:
  glm::dvec3 middle_mm_{0.0};
  glm::dmat3 axes_{1.0};
  glm::dvec3 spread_mm2_{1.0};
  double fle_mm_ = 0.0;
  double count_ = 1.0;
};

}  // namespace calibration
