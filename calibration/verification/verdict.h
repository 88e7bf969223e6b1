// Whether a calibration may be used: errors on held-out touches against limits, with the uncertainty of few touches.
// Green: usable. Amber: usable with a warning. Red: locked on a real device. mm. Pure; any thread. Limits and
// uncertainty factor: reference/calibration 4.1, 4.2.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "calibration/fit/arm_fit.h"

namespace calibration {

enum class Verdict { green, amber, red };
std::string_view nameOf(Verdict verdict);  ///< also in rig files

struct TargetErrors {
  int n = 0;
  double mean_mm = 0.0, rms_mm = 0.0, p95_mm = 0.0, max_mm = 0.0;
  Vector<World> bias_mm;                                   ///< signed mean
  double in_plane_rms_mm = 0.0, along_sight_rms_mm = 0.0;  ///< across and along W's z
};
/// Of the residuals marked used; all zero without any.
TargetErrors targetErrors(const std::vector<Residual>& residuals);

/// The set of limits: full calibration by jig or webcam, by eye only, or the check at the start of a session.
enum class VerificationKind { full, by_eyes, session_check };
std::string_view nameOf(VerificationKind kind);  ///< "full", …; also in rig files

struct VerificationLimit {
  double green_mm, amber_mm;
};
struct VerificationLimits {
  VerificationLimit rms, p95, max, bias;
};
const VerificationLimits& limitsOf(VerificationKind kind);

struct Assessment {
  Verdict verdict = Verdict::red;
  double rms_upper_bound_mm = 0.0;  ///< rms times (1 + 1.65 / sqrt(6 n)): one-sided 95 % bound
  std::string reason;               ///< the deciding limit, one clause with its values
};
/// Fewer than 4 touches are never green.
Assessment assess(const TargetErrors& errors, VerificationKind kind);

/// Position and size of the worst error as the surgeon sees it: "worst: back left low, 0.9 mm". By W's axes through
/// `middle_W`: left/right, low/high, back/front; the middle third of an axis is omitted.
std::string worstErrorSentence(const std::vector<Residual>& residuals, const Point<World>& middle_W);

}  // namespace calibration
