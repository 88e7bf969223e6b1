#include "app/session/session_calibration.h"

#include <cmath>

#include <fmt/core.h>

namespace app {
namespace {

std::string ageText(double days) {
  if (days < 0.0) return "dated in the future";
  const auto whole = static_cast<long>(std::floor(days));
  if (whole < 1) return "measured today";
  return std::to_string(whole) + (whole == 1 ? " day old" : " days old");
}

}  // namespace

std::string calibrationText(const SessionCalibration& c) {
  if (c.rig == "none") return "none";
  std::string words;
  if (!c.verdict.empty())
    words = c.verdict + fmt::format(", {:.2f} mm RMS of {}", c.rms_mm, c.touches);
  else
    words = c.rig == "default" ? "a default rig, not measured" : "never verified";
  if (c.age_days) words += ", " + ageText(*c.age_days);
  if (!c.despite.empty()) words += ", used despite that: " + c.despite;
  return words;
}

}  // namespace app
