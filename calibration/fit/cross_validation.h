// How well a model foretells touches it has not seen: fitted to four fifths, asked of the rest, five times; touches of
// one place stay together. Of few touches each place is left out alone: a fifth of eight is missed more than its worth.
// Also the affine map of nominal tips, for comparison alone. Frame W, mm. Any thread but the servo's; about 1 ms for 27
// touches.
#pragma once

#include <optional>

#include "calibration/fit/kinematic_fit.h"

namespace calibration {

struct CrossValidation {
  double rms_mm = 0.0;
  /// Over what touches of this precision and a usual mismatch would be off, an axis: what models are compared by, for
  /// along the line of sight touches by eye tell little.
  double relative = 0.0;
};

/// Over the touches at these indices, each foretold without its fifth. `whole`: the fit of all of them.
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
