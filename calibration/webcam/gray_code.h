// Stripes of a Gray code on our own screen, and from the images of them which place of the screen a camera sees
// where: thousands of correspondences, no order to guess, mirrored or turned images known as such. Shown are white,
// black, and for every bit of columns, then rows, a pattern and its inverse. px have centres at whole numbers, rows
// from the top. Any thread; decoding 1080p takes about 0.2 s. Not for surfaces other than the flat screen. Sources:
// Posdamer, Altschuler 1982; inverse pairs as in reference/calibration 2.3.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibration/webcam/board.h"

namespace calibration {

struct GrayCode {
  glm::ivec2 screen_px{1920, 1080};
  int cell_px = 16;  ///< width of the finest stripe on the screen: at least four px in the image

  glm::ivec2 cells() const { return (screen_px + cell_px - 1) / cell_px; }
  glm::ivec2 bits() const;  ///< for columns, for rows
  int images() const { return 2 + 2 * (bits().x + bits().y); }
};

/// In the order in which they are shown. Throws CalibrationError for a screen under 64 px or stripes under 2 px.
std::vector<GreyImage> patternImages(const GrayCode& code);

/// A place on the screen and where the camera sees it.
struct ScreenCorrespondence {
  glm::dvec2 screen_px{0.0}, camera_px{0.0};
};

enum class CodeTrouble { not_seen, mirrored, upside_down, mixed_up };

struct CodeDetection {
  std::optional<CodeTrouble> trouble;  ///< none: the sights may be used
  std::string line;                    ///< for people; empty without trouble
  std::vector<ScreenCorrespondence>
      sights;               ///< one for each cell that is seen whole, its centre; empty where there is trouble
  GreyImage mask;           ///< 255 where a pixel was decoded
  double seen_share = 0.0;  ///< of the screen's cells
};

/// Throws CalibrationError for a wrong number of images or sizes that differ.
CodeDetection decoded(const GrayCode& code, const std::vector<GreyImage>& images);

}  // namespace calibration
