// Where a lit tip (a 3 mm ball or a LED) is in a camera's image: the brightest new spot between a image before and
// one with it, less what the room's light did meanwhile. Centre to about 0.2 px. px, centres at whole numbers. Any
// thread; 10 ms at 1080p. Not a tracker: it trusts nothing but these two images. Source: reference/calibration 2.3.
#pragma once

#include <optional>
#include <string>

#include "calibration/webcam/camera.h"

namespace calibration {

enum class SpotTrouble { nothing, several, too_large, at_the_edge, blurred };

struct TipSpot {
  std::optional<SpotTrouble> trouble;  ///< none: the centre may be used
  std::string line;                    ///< for people: what, and what to do
  glm::dvec2 centre_px{0.0};
  double across_px = 0.0;    ///< diameter of a disc of its area, at half its height
  double above_noise = 0.0;  ///< its height over the noise of the difference
};

/// Throws CalibrationError for images whose sizes differ.
TipSpot findTipSpot(const GreyImage& before, const GreyImage& with_tip);

}  // namespace calibration
