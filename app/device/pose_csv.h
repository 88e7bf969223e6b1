// Timed tool poses as CSV: `t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz[,drill][,tool][,action][,button]`, the pose X_PT in
// frame P.
// Reading is strict: rows complete and finite, times rising, quaternions unit within 1 %. Tool and action stay as
// written. Not on the servo thread.
#pragma once

#include <string>
#include <vector>

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"

namespace app {

struct TimedPose {
  double t_s = 0.0;
  calibration::Pose<calibration::Patient, calibration::Tool> X_PT;
  bool drill = true;         ///< the pedal until the next row; true without this column
  bool button = false;       ///< the stylus' second button, until the next row; false without this column
  std::string tool, action;  ///< requested at this row; empty: none
  std::size_t line = 0;      ///< of the file
};

/// "pose file PATH line N".
std::string lineOf(const std::string& path, const TimedPose& pose);

/// Longest pose file that is run tick by tick, s.
inline constexpr double kLongestRun_s = 3600.0;

/// Refuses poses that take longer than kLongestRun_s.
void refuseLongRun(const std::vector<TimedPose>& poses, const std::string& path);

/// Refuses poses with a tool, an action or a button, for commands with one instrument and no controls.
void refuseControls(const std::vector<TimedPose>& poses, const std::string& path);

/// At least one row. Throws UsageError naming file, line and column.
std::vector<TimedPose> readPoses(const std::string& path);

}  // namespace app
