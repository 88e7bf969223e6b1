// Finds a lit tip (a 3 mm ball or an LED): the brightest new spot between an image without and one with it, corrected
// for changes of the room light. Centre to about 0.2 px. px, centres at integers. Any thread; 10 ms at 1080p. Not a
// tracker: uses these two images only. Source: reference/calibration 2.3.
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
  double above_noise = 0.0;  ///< peak over the noise of the difference
};

/// Throws CalibrationError: the images' sizes differ.
TipSpot findTipSpot(const GreyImage& before, const GreyImage& with_tip);

}  // namespace calibration
