// A chessboard that our own screen shows and a camera finds. Odd by even squares, and spots in some of them that draw
// an F: so there is one way only to read it, and a mirrored image is known as one every time. px have their centres
// at whole numbers and rows from the top, on the screen as the surgeon sees it and in the camera's image alike; mm,
// W. Any thread; finding takes 0.1 to 0.5 s, drawing milliseconds. Not a marker board: all its corners must be seen.
#pragma once

#include <vector>

#include "calibration/webcam/chessboard.h"

namespace calibration {

struct ShownBoard {
  glm::ivec2 screen_px{1920, 1080};
  glm::ivec2 squares{13, 8};
  int square_px = 0;
  glm::ivec2 upper_left_px{0};  ///< of its first square

  glm::ivec2 corners() const { return squares - 1; }  ///< inner ones, along x and y
  /// On the screen; row by row from the upper left.
  std::vector<glm::dvec2> cornerPositions_px() const;
  /// Whether the square holds a spot of the F.
  bool hasSpot(const glm::ivec2& square) const;
};

/// As large as it goes on this screen. Throws CalibrationError for a screen under 320 x 200 px.
ShownBoard boardFor(const glm::ivec2& screen_px);
/// What the screen shows.
GreyImage boardImage(const ShownBoard& board);

/// Throws CalibrationError only for a image whose size and bytes disagree.
BoardDetection findBoard(const GreyImage& image, const ShownBoard& board);

}  // namespace calibration
