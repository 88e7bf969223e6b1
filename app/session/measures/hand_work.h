// How the hand worked: times, ways, smoothness, strokes, painting (reference/product 4.4: M1 to M8), and drilling
// without water (S10). A stream over the ticks as recorded: live, from the file and on another machine the same
// samples give the same numbers. One thread; 0.6 µs a tick, strokes included; the
// end of one of 5 s costs 15 ms.
#pragma once

#include <vector>

#include "app/session/measures/measure_value.h"
#include "app/session/measures/painting.h"
#include "app/session/measures/strokes.h"

namespace app {

class HandWork {
 public:
  HandWork();
  HandWork(const HandWork&) = delete;
  HandWork& operator=(const HandWork&) = delete;

  void add(const WorkSample& sample);
  /// So far; a stroke counts once it has ended.
  std::vector<MeasureValue> values() const;
  /// The last stroke ends here.
  void finish() { strokes_.finish(); }

 private:
  void add(const Stroke& stroke);
  void addTimes(const WorkSample& sample);
  void addWay(const WorkSample& sample);

  StrokeFinder strokes_;
  PaintingIndex painting_;
  // M1 times, s
  double total_s_ = 0.0, on_s_ = 0.0, contact_s_ = 0.0, drilling_s_ = 0.0, idle_s_ = 0.0, dry_s_ = 0.0;
  double off_bone_s_ = 0.0;  ///< since the turning bur left the bone
  // M2, M3 ways, mm, and volume
  double free_mm_ = 0.0, contact_mm_ = 0.0, removed_mm3_ = 0.0;
  bool was_valid_ = false;
  glm::dvec3 last_P_mm_{0.0};
  // M8, of the axis to the surface
  double angle_sum_ = 0.0, steep_s_ = 0.0, angled_s_ = 0.0;
  // M4 to M7, by stroke
  std::vector<double> smoothness_, jerk_, tremor_, duration_s_, length_mm_, straightness_, stroke_speed_mm_per_s_,
      stroke_force_N_;
  std::vector<double> run_speed_mm_per_s_;  ///< for tremor: of drilling, a second at most
};

}  // namespace app
