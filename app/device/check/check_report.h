// What a check found, line by line, and the page that is sent to whoever wants to know: a table, and what no machine
// without the unit could prove, ticked off. No patient's data; of the serial number only the end.
#pragma once

#include <string>
#include <vector>

#include "haptics/device/haptic_device.h"

namespace app {

enum class Verdict { ok, wrong, not_tried, not_there };

struct CheckLine {
  std::string what, expected, found;
  Verdict verdict = Verdict::ok;
};

/// One of the things that only a unit can prove (reference/devices 7.3).
enum class Proof { moves, force_sign, force_scale, inkwell, deadman, calibration, axes, rate };

struct CheckReport {
  std::string address, date, program;
  haptics::DeviceCapabilities device;
  std::vector<CheckLine> lines;
  std::vector<Proof> proved;
  bool left_early = false;

  /// Everything that was tried is as it should be, to the end.
  bool isGood() const;
};

/// "…4F21"; empty stays empty.
std::string shortened(const std::string& serial);

/// Markdown.
std::string pageOf(const CheckReport& report);

}  // namespace app
