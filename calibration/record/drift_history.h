// History of checks, re-zeros and calibrations of one rig location: an append-only CSV file,
// `utc,kind,n,rms_mm,bias_x_mm,bias_y_mm,bias_z_mm`, in order. Errors are as found, before any correction; of a
// calibration those of its held-out touches. Frame W, mm. An incomplete last line is ignored. Never on the servo
// thread.
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
  Vector<World> bias_mm;  ///< seen minus true tip, mean
};

/// Empty: no file. Throws CalibrationError naming an unreadable line.
std::vector<DriftEntry> readHistory(const std::filesystem::path& path);

/// Creates file and folder if needed. Throws CalibrationError, leaving the file as it was.
void appendHistory(const std::filesystem::path& path, const DriftEntry& entry);

}  // namespace calibration
