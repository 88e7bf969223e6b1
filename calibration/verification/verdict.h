// Whether a calibration may be used: errors on touches it has not seen, against limits, with how sure so few touches
// can be. Green: use it. Amber: usable, and said. Red: locked on a real device. mm. Pure; any thread.
// Limits and the factor for uncertainty: reference/calibration 4.1, 4.2.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "calibration/fit/arm_fit.h"

namespace calibration {

enum class Verdict { green, amber, red };
std::string_view nameOf(Verdict verdict);  ///< in rig files too: a word that is there keeps its meaning

/// Of touches that were not used for the fit.
struct TargetErrors {
  int n = 0;
  double mean_mm = 0.0, rms_mm = 0.0, p95_mm = 0.0, max_mm = 0.0;
  Vector<World> bias_mm;                                   ///< signed mean
  double in_plane_rms_mm = 0.0, along_sight_rms_mm = 0.0;  ///< across and along W's z
};
/// Of the residuals marked used. Zero of all where there are none.
TargetErrors targetErrors(const std::vector<Residual>& residuals);

/// Against which limits: a full calibration by jig or webcam, by eyes alone, or the check at the start of a session.
enum class VerificationKind { full, by_eyes, session_check };
std::string_view nameOf(VerificationKind kind);  ///< "full", …: in rig files

struct VerificationLimit {
  double green_mm, amber_mm;
};
struct VerificationLimits {
  VerificationLimit rms, p95, max, bias;
};
const VerificationLimits& limitsOf(VerificationKind kind);

struct Assessment {
  Verdict verdict = Verdict::red;
  double rms_upper_bound_mm = 0.0;  ///< rms times (1 + 1.65 / sqrt(6 n)): 95 % sure it is no more
  std::string reason;               ///< which limit decided it, one clause with its numbers
};
/// Fewer than 4 touches are never green.
Assessment assess(const TargetErrors& errors, VerificationKind kind);

/// The one sentence at the end: where the worst error is and how large, as the surgeon sees it: "worst: back left low,
/// 0.9 mm". Places by W's axes through `middle_W`: left/right, low/high, back/front; the middle third of each is not
/// said.
std::string worstErrorSentence(const std::vector<Residual>& residuals, const Point<World>& middle_W);

}  // namespace calibration
