// Cross-validation of an arm model: fitted to four fifths of the touches, tested on the rest, five times; touches of
// one position stay together. Below 20 positions, one position is left out at a time. Also the affine map of nominal
// tips, for comparison only. Frame W, mm. Any thread but the servo's; about 1 ms for 27 touches.
#pragma once

#include <optional>

#include "calibration/fit/kinematic_fit.h"

namespace calibration {

struct CrossValidation {
  double rms_mm = 0.0;
  /// In sigmas of a touch of this precision and usual mismatch, per axis: models are compared by this, because touches
  /// by eye determine little along the line of sight.
  double relative = 0.0;
};

/// Over the touches at these indices. `whole`: the fit of all of them.
CrossValidation crossValidated(const ArmStart& start, const std::vector<Touch>& touches,
                               std::span<const std::size_t> which, const TouchPrecision& precision,
                               const KinematicFit& whole);

/// p_W = A p_D + b of the nominal tips.
struct AffineScore {
  double fre_rms_mm = 0.0, cv_rms_mm = 0.0;
};
/// None: too few touches, or too flat.
std::optional<AffineScore> affineScore(const ArmStart& start, const std::vector<Touch>& touches,
                                       std::span<const std::size_t> which);

}  // namespace calibration
