#include "calibration/webcam/screen_size.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace calibration {
namespace {

constexpr double kRuler_mm = 0.3;
constexpr double kShortestBar_mm = 50.0, kMaxOff = 0.2, kMaxStretched = 0.03;

void refuseScreenSize(const std::string& what, const std::string& mend) {
  throw CalibrationError("screen size: " + what + ", " + mend);
}

std::string percent(double ratio) { return fmt::format("{:+.1f} %", 100.0 * (ratio - 1.0)); }

}  // namespace

SizeCheck checkedSize(const ScreenCorners& nominal, const MeasuredBars& bars) {
  if (!std::isfinite(bars.drawn_mm + bars.across_mm + bars.up_mm))
    refuseScreenSize("a length is not finite", "type it again");
  if (bars.drawn_mm < kShortestBar_mm) refuseScreenSize("the bar is shorter than 50 mm", "draw one of 100 mm or more");
  const double across = bars.across_mm / bars.drawn_mm, up = bars.up_mm / bars.drawn_mm;
  if (std::max(std::abs(across - 1.0), std::abs(up - 1.0)) > kMaxOff)
    refuseScreenSize("a bar is more than 20 % off",
                     "measure in mm, check that the picture fills the monitor and its size in mm");
  if (std::abs(across / up - 1.0) > kMaxStretched)
    refuseScreenSize("the picture is stretched by " + percent(across / up),
                     "set the monitor to its own resolution, no overscan");

  SizeCheck check{.across = across, .up = up, .agrees = true, .corners = nominal, .line = ""};
  check.agrees = std::max(std::abs(across - 1.0), std::abs(up - 1.0)) * bars.drawn_mm <= kRuler_mm;
  if (check.agrees) {
    check.line = "the screen's size is right within what a ruler reads (0.3 mm)";
    return check;
  }
  check.corners = screenAround(nominal.centre_mm(), across * nominal.across_mm(), up * nominal.up_mm(), nominal.px);
  check.line = "the screen's size was corrected by " + percent(across) + " across and " + percent(up) + " up";
  return check;
}

}  // namespace calibration
