// Fits a camera's lens to views of a flat board: focal lengths, centre, k1, k2, p1, p2; k3 is 0. Outlier views are
// named and left out. Too few, too frontal or too similar views are refused, because a lens fitted to them has small
// residuals and is wrong. px, mm. Any thread; under 1 s for 15 views of 84 corners. Source: Zhang, PAMI 2000, as
// OpenCV's calibrateCamera; reference/calibration 2.3, 3.3.
#pragma once

#include <string>
#include <vector>

#include "calibration/calibration_error.h"
#include "calibration/webcam/camera.h"

namespace calibration {

/// Corners of one image, in the board's order.
struct BoardView {
  std::string name;  ///< for messages: a file name, "view 3"
  std::vector<glm::dvec2> corners_px;
};

inline constexpr std::size_t kMinViews = 8;

struct Intrinsics {
  CameraModel camera;
  double rms_px = 0.0;                ///< over the views used
  std::vector<double> view_rms_px;    ///< of every view given
  std::vector<std::string> left_out;  ///< of outlier views
  double covered_share = 0.0;         ///< fraction of the image's 6 x 4 fields that hold a corner
  double max_slant_deg = 0.0;         ///< of the boards
};

/// `positions_mm`: of the board's corners, in its plane. Throws CalibrationError with the remedy: fewer than 8 views,
/// views that do not match the board, all slanted less than 15°, less than half of the image covered, more than a third
/// of the views left out, or an implausible lens.
Intrinsics fitIntrinsics(const glm::ivec2& size_px, const std::vector<glm::dvec2>& positions_mm,
                         const std::vector<BoardView>& views);

}  // namespace calibration
