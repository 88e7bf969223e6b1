// The chessboard that the program shows on its screen and a camera finds. Odd by even squares with spots that draw an
// F: its orientation is unique and a mirrored image is always detected. px with centres at integers and rows from the
// top, on the screen as the surgeon sees it and in the camera's image; mm, W. Any thread; finding takes 0.1 to 0.5 s,
// drawing milliseconds. All its corners must be visible.
#pragma once

#include <vector>

#include "calibration/webcam/chessboard.h"

namespace calibration {

struct ShownBoard {
  glm::ivec2 screen_px{1920, 1080};
  glm::ivec2 squares{13, 8};
  int square_px = 0;
  glm::ivec2 upper_left_px{0};  ///< of the first square

  glm::ivec2 corners() const { return squares - 1; }  ///< inner corners along x and y
  /// On the screen, row by row from the upper left.
  std::vector<glm::dvec2> cornerPositions_px() const;
  bool hasSpot(const glm::ivec2& square) const;
};

/// As large as fits on this screen. Throws CalibrationError: a screen under 320 x 200 px.
ShownBoard boardFor(const glm::ivec2& screen_px);
/// The image to show.
GreyImage boardImage(const ShownBoard& board);

/// Throws CalibrationError: the image's size and bytes disagree.
BoardDetection findBoard(const GreyImage& image, const ShownBoard& board);

}  // namespace calibration
