// Seen error: how far from the true stylus tip a surgeon sees the drawn one, from the calibrated arm's error, the
// screen's and the eyes' deviations from where the image was drawn for, by triangulating two lines of sight. Frame W,
// mm. Pure functions of the generator; any thread but the servo's.
//   One seating: eyes, pupillary distance and screen drawn once, then kept; errors over points of the box.
//   mean, RMS: over its points. max: its worst point. Over many rigs, one seating each: the mean of the means, and the
//   worst point of the worst rig. Near the screen, z towards the eyes, at D: head shift e moves a point by e z / D,
//   pupils wrong by b of B move it b/B z (D - z) / D in depth (reference/calibration 1.4).
#pragma once

#include "calibration/synthetic/synthetic_rig.h"

namespace calibration {

/// Eyes and virtual screen, assumed or true.
struct Viewing {
  Point<World> left_eye, right_eye;
  Pose<World, ScreenImage> X_WI;  ///< the screen is the plane z = 0 of I, x along its rows
};
Viewing believedViewing(const Rig& rig);

/// Where a surgeon sees what was drawn at a point for `drawn_for`: the centre of the shortest link between the lines of
/// sight.
Point<World> seenPlace(const Viewing& drawn_for, const Viewing& seen_by, const Point<World>& drawn_W);

/// How well the eyes and the screen are known.
struct ViewingCare {
  double head_sd_mm = 5.0;           ///< an axis; a chin rest
  double pupils_mm = 1.0;            ///< of their distance, at most: a ruler or a pupillometer
  double screen_shift_sd_mm = 0.1;   ///< an axis
  double screen_turn_sd_deg = 0.05;  ///< an axis
};
Viewing actualViewing(const Viewing& believed, const ViewingCare& care, std::mt19937& rng);

struct SeenError {
  int positions = 0;
  double mean_mm = 0.0, rms_mm = 0.0, max_mm = 0.0;
};
/// Of one rig with this calibration and one seating: at `places` points in ±`half_mm`, tilts as of held-out touches.
SeenError seenError(const SyntheticRig& rig, const MeasuredArm& calibrated, const glm::dvec3& half_mm,
                    const ViewingCare& care, int positions, std::mt19937& rng);

}  // namespace calibration
