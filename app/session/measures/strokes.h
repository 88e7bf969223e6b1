// The strokes of a bur that drills in bone: from one turn of its way to the next. A turn is the lowest point of each
// run in which the cosine between the ways of the 25 ms before and after is below 0 (k-cos, reference/product R90).
// Work that stops for longer than 0.3 s, or an invalid pose, ends a stroke; so do 5 s without a turn. A stroke shorter
// than 0.5 mm is none: it is the hand's rest (our default). Frame P; mm, N, s. A stream: one thread, constant work a
// tick but at a turn; keeps at most 5 s of samples.
#pragma once

#include <functional>
#include <vector>

#include "app/session/measures/work_sample.h"

namespace app {

struct Stroke {
  double begin_s = 0.0, duration_s = 0.0;
  double length_mm = 0.0;     ///< along the way
  double straightness = 1.0;  ///< chord over length
  double mean_speed_mm_per_s = 0.0;
  double mean_normal_force_N = 0.0;
  double removed_mm3 = 0.0;
  double depth_mm = 0.0;   ///< of a groove in flat bone with this length, volume and the bur's radius
  double radius_mm = 0.0;  ///< of the bur
  double dt_s = 0.0;       ///< of its samples
  glm::dvec3 middle_P_mm{0.0}, chord_P_mm{0.0}, normal_P{0.0};
  std::vector<double> speed_mm_per_s;  ///< of the hand, at each tick
};

class StrokeFinder {
 public:
  static constexpr double kArm_s = 0.025, kPause_s = 0.3, kLongest_s = 5.0, kShortest_mm = 0.5;

  explicit StrokeFinder(std::function<void(const Stroke&)> found) : found_(std::move(found)) {}

  void add(const WorkSample& sample);
  /// The last stroke ends here.
  void finish();

 private:
  void lookForTurn();
  void endStroke(std::size_t end);
  void endRun();
  double cosineAt(std::size_t k) const;

  std::function<void(const Stroke&)> found_;
  std::vector<WorkSample> samples_;        ///< of this run, from the last turn on but an arm before it
  std::size_t begin_ = 0;                  ///< of the stroke, in them
  std::size_t looked_ = 0;                 ///< of which the cosine was looked at
  std::size_t low_from_ = 0, low_to_ = 0;  ///< where this run of negative cosines was lowest so far, to 0.01
  double lowest_ = 0.0;                    ///< its cosine; 0: no such run
  double idle_s_ = 0.0;
};

/// The depth of a groove of this section in flat bone, made by a ball: h of R^2 acos(1 - h/R) - (R - h) sqrt(2 R h -
/// h^2); beyond half the ball the rest goes straight down, at most 4 R. By bisection, to 1e-6 R.
double grooveDepth_mm(double section_mm2, double radius_mm);

}  // namespace app
