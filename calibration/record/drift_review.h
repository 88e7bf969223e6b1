// What the history of a place says: whether the arm still stands where its calibration found it. Four charts, RMS and
// the bias along each axis of W, over the checks and re-zeros since the last calibration; each value is charted by
// those before it, by the first twenty at most. A small RMS is no alarm. mm. Pure; any thread. Source of the rules:
// control_chart.h; that they be used: reference/calibration 4.3.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "calibration/record/control_chart.h"
#include "calibration/record/drift_history.h"

namespace calibration {

inline constexpr std::size_t kMinBaseline = 8, kMaxBaseline = 20;
/// An encoder's step at the tip (reference/calibration 1.2): no check repeats more finely.
inline constexpr double kMinSigma_mm = 0.055;

enum class DriftQuantity { rms, right, up, nearer };
inline constexpr std::array kDriftQuantities = {DriftQuantity::rms, DriftQuantity::right, DriftQuantity::up,
                                                DriftQuantity::nearer};
std::string_view nameOf(DriftQuantity quantity);  ///< "RMS", "bias to the right", …
double valueOf_mm(const DriftEntry& entry, DriftQuantity quantity);

struct DriftAlarm {
  std::size_t entry = 0;  ///< in the history
  DriftQuantity quantity = DriftQuantity::rms;
  ControlRule rule = ControlRule::one_beyond_3;
  std::string sentence;  ///< "2026-11-20: RMS 1.42 mm, beyond 3 sigma (mean 0.31 mm, sigma 0.06 mm)"
};

struct DriftReview {
  std::vector<std::size_t> charted;                    ///< entries on the charts, oldest first
  std::array<std::optional<ControlLimits>, 4> limits;  ///< by DriftQuantity; as the next check will be charted
  std::vector<DriftAlarm> alarms;                      ///< oldest first
  std::string sentence;                                ///< how it stands now, and what to do
  bool alarmed = false;                                ///< the newest entry has an alarm
};
DriftReview reviewOf(const std::vector<DriftEntry>& history);

}  // namespace calibration
