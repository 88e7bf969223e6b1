// Where one stroke of the drill ends and the next begins, so that undo takes back what a surgeon would call one stroke:
// a pause of 0.3 s, a reversal of 1 mm, 3 s or 5 mm3, whichever is first. A reversal: the bur is 1 mm nearer to where
// the stroke began than the stroke has reached; the next begins there, at the turn. What has removed less than 0.05 mm3
// is no stroke yet, it goes on with the next: else undo takes back what nobody sees. Values chosen from use: an
// ostectomy of 70 mm3 is 20 to 40 strokes of 1 to 3 s. Frame P. Servo thread; a few operations a tick, no allocation,
// no throw.
#pragma once

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"

namespace haptics {

class StrokeExtent {
 public:
  static constexpr double kPause_s = 0.3, kReversal_mm = 1.0, kLongest_s = 3.0, kSmallest_mm3 = 0.05,
                          kLargest_mm3 = 5.0;

  /// Once a tick. `cutting`: the turning bur was in bone at `bur_P`. True: the stroke ends with this tick.
  bool endsAt(bool cutting, const calibration::Point<calibration::Patient>& bur_P, double removed_mm3,
              double dt_s) noexcept;

 private:
  void begin(const calibration::Point<calibration::Patient>& at_P) noexcept;

  /// The way of the bur ends; whether the stroke does.
  bool ends() noexcept;

  bool open_ = false;
  calibration::Point<calibration::Patient> start_P_, turn_P_;  ///< turn: the place furthest from the start
  double pause_s_ = 0.0, time_s_ = 0.0, volume_mm3_ = 0.0, furthest_mm_ = 0.0;
};

}  // namespace haptics
