// The result of a device check, line by line, and its page in Markdown: a table, and a checklist of what only a real
// unit can show. No patient data; of the serial number only the end.
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

/// What only a real unit can show (reference/devices 7.3).
enum class Evidence { moves, force_sign, force_scale, inkwell, deadman, calibration, axes, rate };

struct CheckReport {
  std::string address, date, program;
  haptics::DeviceCapabilities device;
  std::vector<CheckLine> lines;
  std::vector<Evidence> confirmed;
  bool left_early = false;

  /// Complete, and nothing tried was wrong.
  bool isGood() const;
};

/// "…4F21"; empty stays empty.
std::string shortened(const std::string& serial);

/// Markdown.
std::string pageOf(const CheckReport& report);

}  // namespace app
