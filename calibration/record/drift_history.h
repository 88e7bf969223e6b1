// What checks, re-zeros and calibrations have found at one place, in the order they were made: a CSV file that only
// grows, `utc,kind,n,rms_mm,bias_x_mm,bias_y_mm,bias_z_mm`. Errors as they were found, before anything was put right;
// of a calibration those of its held-out touches. Frame W, mm. A line that a kill has torn is none. Not the servo.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "calibration/calibration_error.h"
#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"

namespace calibration {

enum class DriftKind { check, rezero, calibration };
std::string_view nameOf(DriftKind kind);

struct DriftEntry {
  std::string utc;
  DriftKind kind = DriftKind::check;
  int n = 0;  ///< touches
  double rms_mm = 0.0;
  Vector<World> bias_mm;  ///< where the tip is seen, less where it is: signed mean
};

/// Empty where there is no file. Throws CalibrationError naming the line that can not be read.
std::vector<DriftEntry> readHistory(const std::filesystem::path& path);

/// Makes file and folder where there are none. Throws CalibrationError; the file is then as it was.
void appendHistory(const std::filesystem::path& path, const DriftEntry& entry);

}  // namespace calibration
