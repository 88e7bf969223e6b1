// Numbers of samples against the steady clock, from when pieces of sound arrived. Pieces come late, never early: the
// least of (arrival - frame / rate) in each 10 s, joined by straight lines, is the map; sound itself is never
// resampled (evaluation A3: within 1 ms where the oscillator is off by 300 ppm and callbacks are late by up to 200 ms).
// What it cannot see is a constant delay. A gap ends one stretch of the map and begins the next. Also ticks, which are
// told late by frames, are mapped so. Times ns; pure; any one thread.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace app {

struct ClockRow {
  std::uint64_t frame = 0;  ///< all before it had arrived; of a gap: the first that is silence
  std::int64_t t_ns = 0;
  std::uint64_t gap_frames = 0;  ///< 0: no gap

  bool operator==(const ClockRow&) const = default;
};

inline constexpr std::string_view kClockHeader = "frame,t_ns,gap_frames\n";
std::string clockLine(const ClockRow& row);
/// Rows of a file with the header, in order of frames; a last line that was cut off is left out. None: it is no such
/// file.
std::optional<std::vector<ClockRow>> clockRowsFrom(std::string_view text);

class ClockMap {
 public:
  /// Rows in order of frames. Without any, frame 0 is at time 0.
  ClockMap(std::span<const ClockRow> rows, double rate_Hz);

  std::int64_t t_ns(double frame) const;
  /// That is heard at that time; within a gap, and before the first: as the map goes on from there.
  double frame(std::int64_t t_ns) const;
  bool isKnown() const { return !stretches_.empty(); }
  /// How far the samples' clock is off, from the first minimum to the last one of the longest stretch; 0 in less than
  /// 20 s.
  double drift_ppm() const;

 private:
  struct Knot {
    double frame = 0.0, offset_ns = 0.0;
  };
  struct Stretch {
    double first_frame = 0.0;
    std::vector<Knot> knots;

    double offset_ns(double frame) const;
  };
  const Stretch& stretchAt(double frame) const;
  double time_ns(const Stretch& stretch, double frame) const;

  double frame_ns_;
  std::int64_t origin_ns_ = 0;  ///< so that offsets keep their digits
  std::vector<Stretch> stretches_;
};

}  // namespace app
