// Touches as a YAML file (OpenCV FileStorage): `device_model`, `observations: [{ id, joints_rad: [6], p_W_mm: [3], used
// }]`; optional `serial`, `mount`, `method`, `precision_mm: [in plane, along sight]`. Start-up only.
#pragma once

#include <string>

#include "calibration/checked_yaml.h"
#include "calibration/fit/touches.h"

namespace calibration {

/// Throws CalibrationError with file, touch and remedy: unreadable, truncated, not finite, unknown model, more than
/// 10,000 touches, beyond 2 m, angles beyond two turns. Duplicates and collinear sets are checked by the fit.
TouchSet readTouches(const std::string& path);

/// Parts of such files, for other readers too: `joints_rad` of a map, and the limit of a target.
RawJoints jointsIn(const CheckedYaml& yaml, const cv::FileNode& node, const std::string& where);
inline constexpr CheckedYaml::Limit kFarthest{2000.0, "2 m", "give mm in frame W"};

/// The text of such a file; the caller writes it.
std::string touchesText(const TouchSet& set);

}  // namespace calibration
