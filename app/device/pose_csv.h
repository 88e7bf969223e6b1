// Timed tool poses as CSV: `t_s,px_mm,py_mm,pz_mm,qw,qx,qy,qz[,drill][,tool][,action]`, the pose X_PT in frame P.
// Reading is strict: every row complete, finite, times rising, quaternions unit within 1 %. What tool and action ask
// for is as written: who obeys them knows what they may be. Not on the servo thread.
#pragma once

#include <string>
#include <vector>

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"

namespace app {

struct TimedPose {
  double t_s = 0.0;
  calibration::Pose<calibration::Patient, calibration::Tool> X_PT;
  bool drill = true;         ///< the pedal from this row to the next; true where the file has no such column
  std::string tool, action;  ///< asked for at this row; empty: nothing
  std::size_t line = 0;      ///< of the file
};

/// "pose file PATH line N".
std::string lineOf(const std::string& path, const TimedPose& pose);

/// Longest span of poses that is run through tick by tick, s.
inline constexpr double kLongestRun_s = 3600.0;

/// Refuses poses that take longer than kLongestRun_s.
void refuseLongRun(const std::vector<TimedPose>& poses, const std::string& path);

/// Refuses poses that ask for a tool or an action: where one instrument is given and there are no controls.
void refuseControls(const std::vector<TimedPose>& poses, const std::string& path);

/// At least one row. Throws UsageError naming file, line and column.
std::vector<TimedPose> readPoses(const std::string& path);

}  // namespace app
