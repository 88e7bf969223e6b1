// The voice of a recorded session by its time: segments are found through the clock's map, gaps and what is missing are
// silence. Ticks are found through a map of their own. One segment is kept unpacked. One thread; 5 ms where another
// segment begins.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/evaluation/voice/clock_map.h"
#include "app/evaluation/voice/voice_files.h"

namespace app {

class VoiceTrack {
 public:
  /// `session`: its folder. None: it has no voice. Throws LoadError: its clock cannot be read.
  /// Segments that are sealed and cannot be opened are silence.
  static std::optional<VoiceTrack> of(const std::string& session, double tick_rate_Hz, SegmentOpener opener = {});

  /// Samples at 48 kHz from a sample on.
  void read(std::int64_t first, std::span<float> out);
  /// The sample that is heard then, on the station's clock.
  std::int64_t frameAt(std::int64_t t_ns) const;
  /// Of a tick; none: ticks were not told.
  std::optional<std::int64_t> timeOfTick(double tick) const;
  /// Of the end of the last segment.
  std::int64_t frames() const { return frames_; }
  const ClockMap& map() const { return map_; }

 private:
  VoiceTrack(std::string folder, std::span<const ClockRow> rows, std::span<const ClockRow> ticks, double tick_rate_Hz,
             SegmentOpener opener);
  void load(std::uint64_t number);

  std::string folder_;
  SegmentOpener opener_;
  ClockMap map_, ticks_;
  std::int64_t frames_ = 0;
  std::optional<std::uint64_t> loaded_;
  std::vector<float> segment_;  ///< that one; shorter: silence behind it
};

}  // namespace app
