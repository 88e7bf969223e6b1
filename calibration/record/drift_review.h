// Whether the arm still is where its calibration found it. Four charts, RMS and the bias along each axis of W, over the
// checks and re-zeros since the last calibration; the limits for a value come from those before it, the first twenty at
// most. A low RMS raises no alarm. mm. Pure; any thread. Sources: control_chart.h; reference/calibration 4.3.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "calibration/record/control_chart.h"
#include "calibration/record/drift_history.h"
#include "calibration/record/rig_record.h"

namespace calibration {

inline constexpr std::size_t kMinBaseline = 8, kMaxBaseline = 20;
/// An encoder step at the tip (reference/calibration 1.2): the resolution of a check.
inline constexpr double kMinSigma_mm = 0.055;

enum class DriftQuantity { rms, right, up, nearer };
inline constexpr std::array kDriftQuantities = {DriftQuantity::rms, DriftQuantity::right, DriftQuantity::up,
                                                DriftQuantity::nearer};
std::string_view nameOf(DriftQuantity quantity);  ///< "RMS", "bias to the right", …
double valueOf_mm(const DriftEntry& entry, DriftQuantity quantity);

struct DriftAlarm {
  std::size_t entry = 0;  ///< index in the history
  DriftQuantity quantity = DriftQuantity::rms;
  ControlRule rule = ControlRule::one_beyond_3;
  std::string sentence;  ///< "2026-11-20: RMS 1.42 mm, beyond 3 sigma (mean 0.31 mm, sigma 0.06 mm)"
};

struct DriftReview {
  std::vector<std::size_t> charted;                    ///< entries on the charts, oldest first
  std::array<std::optional<ControlLimits>, 4> limits;  ///< by DriftQuantity; for the next check
  std::vector<DriftAlarm> alarms;                      ///< oldest first
  std::string sentence;                                ///< the present state, and what to do
  bool alarmed = false;                                ///< the newest entry has an alarm
};
DriftReview reviewOf(const std::vector<DriftEntry>& history);

/// `record` with the latest check as its verification if that was worse: a base that was pushed later is not green. The
/// history has RMS and bias only: the 95 % and largest errors are set to the RMS, their lower bound.
RigRecord withLaterCheck(RigRecord record, const std::vector<DriftEntry>& history);

}  // namespace calibration
