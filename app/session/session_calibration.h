// How hand and eye were aligned while a session was recorded: which rig, how good it was proved to be and when, and the
// word by which it was used although it was red. mm. Plain values; any thread. Never carries a person's name.
#pragma once

#include <optional>
#include <string>

namespace app {

struct SessionCalibration {
  std::string rig = "none";  ///< hash of the rig file; "default": one of the program's own; "unsealed": without a hash
  std::string rig_id, device_serial;
  std::string verdict;  ///< "green", "amber", "red"; empty: never proved
  int touches = 0;      ///< that proved it
  double rms_mm = 0.0, p95_mm = 0.0, max_mm = 0.0;
  std::string checked_utc;
  std::optional<double> age_days;  ///< of the rig, when the session began
  std::string despite;             ///< why it was used although red; empty: it was not
};

/// Each field with its key, in the order they were first stored in.
void forEachField(auto& calibration, auto&& visit) {
  auto& [rig, rig_id, device_serial, verdict, touches, rms_mm, p95_mm, max_mm, checked_utc, age_days, despite] =
      calibration;
  visit("rig", rig), visit("rig_id", rig_id), visit("device_serial", device_serial), visit("verdict", verdict);
  visit("touches", touches), visit("rms_mm", rms_mm), visit("p95_mm", p95_mm), visit("max_mm", max_mm);
  visit("checked_utc", checked_utc), visit("age_days", age_days), visit("despite", despite);
}

/// "green, 0.24 mm RMS of 16, 3 days old"; "none"; "never proved, 12 days old"; "red, … used despite: WORD".
std::string calibrationText(const SessionCalibration& calibration);

}  // namespace app
