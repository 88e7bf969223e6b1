// Finds a chessboard in an image and checks that it is good enough to measure by: complete, sharp, near, not oblique.
// px, centres at integers, rows from the top. Any thread; 0.1 to 0.5 s at 1080p, up to 2 s without a board. The corner
// order is ambiguous; board.h resolves it for the program's own board. Source: OpenCV's findChessboardCornersSB (Duda,
// Frese, BMVC 2018) and cornerSubPix; reference/calibration 2.3, 3.3.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "calibration/webcam/camera.h"

namespace calibration {

/// mirrored: only detected by board.h.
enum class BoardTrouble { not_found, cropped, mirrored, blurred, too_small, too_oblique };

struct BoardDetection {
  std::optional<BoardTrouble> trouble;  ///< none: found, the corners may be used
  std::string line;                     ///< for people: what, and what to do; empty if found
  std::vector<glm::dvec2> corners_px;   ///< empty if there is trouble
  double edge_px = 0.0;                 ///< 10 to 90 % width of an edge
  double slant_deg = 0.0;               ///< approximate angle between line of sight and board normal

  /// The same without corners, for this reason.
  BoardDetection rejected(BoardTrouble why, std::string what_to_do) const {
    return {why, std::move(what_to_do), {}, edge_px, slant_deg};
  }
};

/// A plain chessboard, printed or shown, with this number of inner corners; their order may be rotated or mirrored. For
/// lenses. Throws CalibrationError: the image's size and bytes disagree.
BoardDetection findChessboard(const GreyImage& image, const glm::ivec2& corners);

}  // namespace calibration
