// A chessboard in a image, and whether it is seen well enough to be measured by: whole, sharp, near, not from the
// side. px, centres at whole numbers, rows from the top. Any thread; 0.1 to 0.5 s at 1080p, where there is none up to 2
// s. Which corner is which it does not know: board.h does, of our own. Source: OpenCV's findChessboardCornersSB (Duda,
// Frese, BMVC 2018) and cornerSubPix; reference/calibration 2.3, 3.3.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibration/webcam/camera.h"

namespace calibration {

/// Mirrored: only where the board can tell (board.h).
enum class BoardTrouble { not_found, cropped, mirrored, blurred, too_small, too_oblique };

struct BoardDetection {
  std::optional<BoardTrouble> trouble;  ///< none: it was found, and its corners may be used
  std::string line;                     ///< for people: what, and what to do; empty where it was found
  std::vector<glm::dvec2> corners_px;   ///< in the image, empty where there is trouble
  double edge_px = 0.0;                 ///< over how many px an edge rises from 10 to 90 %
  double slant_deg = 0.0;               ///< of the line of sight from the board's normal, about
};

/// A plain chessboard, printed or shown, with so many inner corners, in an order that may be turned or mirrored: for
/// lenses. Throws CalibrationError only for a image whose size and bytes disagree.
BoardDetection findChessboard(const GreyImage& image, const glm::ivec2& corners);

}  // namespace calibration
