// Detects a stylus held still and returns the median of its sensors over the last 0.2 s. Still means: over 0.4 s, wrist
// and tip below 2 mm/s and within 0.03 mm, both of 0.1 s means, which remove a tremor of 8 to 12 Hz but not a drift.
// Frame D, mm, s. 500 to 10,000 Hz; of faster devices one sample per millisecond is used. Plain values; one thread;
// about 10 us every 20 ms. Limits: reference/calibration 4.5; the wider ones for crosses in free air are ours.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/calibrate/stylus_sample.h"

namespace app {

struct StillLimits {
  double hold_s = 0.4;
  double speed_mm_per_s = 2.0;
  double sd_mm = 0.03;    ///< of any axis, of the means
  double swing_mm = 0.6;  ///< the farthest sample from the middle
};
inline constexpr StillLimits kPitStillness{}, kCrossStillness{0.4, 2.0, 0.1, 1.2};

struct StillReading {
  calibration::RawJoints raw_rad{};  ///< medians
  int samples = 0;
  double sd_mm = 0.0;  ///< of the means, the worst axis
};

class StillCapture {
 public:
  explicit StillCapture(const StillLimits& limits = kPitStillness);

  void update(const StylusSample& sample);

  /// 0 to 1: for how much of the time it has been still. 0 until it has left where it was taken last.
  double progress() const { return progress_; }
  /// Held still long enough, once for each place.
  std::optional<StillReading> heldStill() const;
  /// The 0.2 s before a press; none: `why` says it in words.
  std::optional<StillReading> before(double t_s, std::string& why) const;

  /// It counts again once the stylus has gone 5 mm or turned 5° from here.
  void waitForMove();
  void forget();

 private:
  struct Seen {
    double t_s = 0.0;
    calibration::RawJoints raw_rad{};
    glm::dvec3 wrist_D_mm{0.0}, tip_D_mm{0.0};
  };
  struct Stillness {
    double still_s = 0.0, sd_mm = 0.0, speed_mm_per_s = 0.0, swing_mm = 0.0;
    bool gap = false;
  };

  const Seen& back(std::size_t n) const;
  /// How long, up to `most_s`, it had been still at `end_s`; and what it was like over all of that time.
  Stillness stillness(double end_s, double most_s) const;
  StillReading median(double end_s) const;

  StillLimits limits_;
  std::vector<Seen> ring_;
  std::size_t newest_ = 0, count_ = 0;
  double looked_s_ = -1e9, progress_ = 0.0;
  bool left_ = false;
  std::optional<Seen> left_from_;
};

}  // namespace app
