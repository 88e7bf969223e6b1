// The calibration of a recorded session: which rig, its verified error and age, and the word given to use it although
// red. mm. Plain values; any thread. Never a person's name.
#pragma once

#include <optional>
#include <string>

namespace app {

struct SessionCalibration {
  std::string rig = "none";  ///< hash of the rig file; "default": one of the program's own; "unsealed": no hash
  std::string rig_id, device_serial;
  std::string verdict;  ///< "green", "amber", "red"; empty: never verified
  int touches = 0;      ///< of the verification
  double rms_mm = 0.0, p95_mm = 0.0, max_mm = 0.0;
  std::string checked_utc;
  std::optional<double> age_days;  ///< of the rig at the start of the session
  std::string despite;             ///< the word given although red; empty: not red
};

/// Visits each field with its key, in the order of schema 4.
void forEachField(auto& calibration, auto&& visit) {
  auto& [rig, rig_id, device_serial, verdict, touches, rms_mm, p95_mm, max_mm, checked_utc, age_days, despite] =
      calibration;
  visit("rig", rig), visit("rig_id", rig_id), visit("device_serial", device_serial), visit("verdict", verdict);
  visit("touches", touches), visit("rms_mm", rms_mm), visit("p95_mm", p95_mm), visit("max_mm", max_mm);
  visit("checked_utc", checked_utc), visit("age_days", age_days), visit("despite", despite);
}

/// "green, 0.24 mm RMS of 16, 3 days old"; "none"; "never verified, 12 days old"; "red, … used despite that: WORD".
std::string calibrationText(const SessionCalibration& calibration);

}  // namespace app
