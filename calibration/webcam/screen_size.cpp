#include "calibration/webcam/screen_size.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace calibration {
namespace {

constexpr double kRuler_mm = 0.3;
constexpr double kShortestBar_mm = 50.0, kMostOff = 0.2, kMostStretched = 0.03;

void refuseScreenSize(const std::string& what, const std::string& mend) {
  throw CalibrationError("screen size: " + what + ", " + mend);
}

std::string percent(double ratio) { return fmt::format("{:+.1f} %", 100.0 * (ratio - 1.0)); }

}  // namespace

SizeCheck checkedSize(const ScreenCorners& believed, const MeasuredBars& bars) {
  if (!std::isfinite(bars.drawn_mm + bars.across_mm + bars.up_mm))
    refuseScreenSize("a length is no number", "type it again");
  if (bars.drawn_mm < kShortestBar_mm) refuseScreenSize("the bar is shorter than 50 mm", "draw one of 100 mm or more");
  const double across = bars.across_mm / bars.drawn_mm, up = bars.up_mm / bars.drawn_mm;
  if (std::max(std::abs(across - 1.0), std::abs(up - 1.0)) > kMostOff)
    refuseScreenSize("a bar is more than 20 % off",
                     "measure in mm, check that the picture fills the monitor and its size in mm");
  if (std::abs(across / up - 1.0) > kMostStretched)
    refuseScreenSize("the picture is stretched by " + percent(across / up),
                     "set the monitor to its own resolution, no overscan");

  SizeCheck check{.across = across, .up = up, .agrees = true, .corners = believed, .line = ""};
  check.agrees = std::max(std::abs(across - 1.0), std::abs(up - 1.0)) * bars.drawn_mm <= kRuler_mm;
  if (check.agrees) {
    check.line = "the screen's size is right within what a ruler reads (0.3 mm)";
    return check;
  }
  // About the middle, each way by itself.
  const glm::dvec3 right = believed.lower_right.mm - believed.lower_left.mm;
  const glm::dvec3 upward = believed.upper_left.mm - believed.lower_left.mm;
  const glm::dvec3 middle = believed.lower_left.mm + 0.5 * (right + upward);
  check.corners.lower_left = {middle - 0.5 * (across * right + up * upward)};
  check.corners.lower_right = {middle + 0.5 * (across * right - up * upward)};
  check.corners.upper_left = {middle - 0.5 * (across * right - up * upward)};
  check.line = "the screen's size was corrected by " + percent(across) + " across and " + percent(up) + " up";
  return check;
}

}  // namespace calibration
