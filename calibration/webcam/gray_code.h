// Gray code stripes on the program's screen, and their decoding: dense correspondences between screen and camera, with
// mirrored or rotated images detected. Shown are white, black, and for every bit of columns, then rows, a pattern and
// its inverse. px with centres at integers, rows from the top. Any thread; decoding 1080p takes about 0.2 s. For flat
// screens only. Sources: Posdamer, Altschuler 1982; inverse pairs as in reference/calibration 2.3.
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

/// In display order. Throws CalibrationError: a screen under 64 px or stripes under 2 px.
std::vector<GreyImage> patternImages(const GrayCode& code);

/// A point of the screen and its image.
struct ScreenCorrespondence {
  glm::dvec2 screen_px{0.0}, camera_px{0.0};
};

enum class CodeTrouble { not_seen, mirrored, upside_down, mixed_up };

struct CodeDetection {
  std::optional<CodeTrouble> trouble;  ///< none: the correspondences may be used
  std::string line;                    ///< for people; empty without trouble
  /// The centre of each completely visible cell; empty if there is trouble.
  std::vector<ScreenCorrespondence> correspondences;
};

/// Throws CalibrationError: wrong number of images, or differing sizes.
CodeDetection decoded(const GrayCode& code, const std::vector<GreyImage>& images);

}  // namespace calibration
