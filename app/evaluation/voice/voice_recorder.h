// Makes segments and rows of the clock from what is heard: a segment is handed on every second, so that a kill loses
// less than two, rows at 10 Hz, of each tenth of a second the one that came earliest. Samples that were lost are a gap:
// a row, and silence of its length. Where the card does not say how many it lost, the pieces of the next half second
// tell. After what a killed one has left it goes on, with a gap. Pure but for the sinks; one thread; microseconds a
// block, and what the sinks take.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "app/evaluation/voice/clock_map.h"
#include "app/evaluation/voice/heard_block.h"

namespace app {

inline constexpr std::size_t kSegmentFrames = 96'000;  ///< 2 s at 48 kHz

/// What one that was killed has left.
struct VoicePast {
  std::vector<ClockRow> rows;
  std::uint64_t segment = 0;   ///< the newest
  std::vector<float> samples;  ///< of it
};

class VoiceRecorder {
 public:
  struct Sinks {
    /// All of it so far: the same number comes again, longer, until it is whole.
    std::function<void(std::uint64_t number, std::span<const float> samples)> segment;
    std::function<void(const ClockRow& row)> row;
  };
  explicit VoiceRecorder(Sinks sinks, VoicePast past = {});

  void add(const HeardBlock& block);
  /// All that was heard is handed on.
  void finish();

  /// Samples so far, silence of gaps included.
  std::uint64_t frames() const { return frames_; }
  std::uint64_t gaps() const { return gaps_; }
  /// Of all rows so far.
  ClockMap map() const;
  /// Recorded from `first` on, of the newest 4 s; silence where it is older.
  std::vector<float> newest(std::uint64_t first, std::size_t count) const;

 private:
  void resolveOverrun();
  void nextSegment();
  void append(const HeardBlock& block);
  void appendSilence(std::uint64_t count);
  void addGap(std::uint64_t count, std::int64_t t_ns);
  void addSample(float sample);
  void keepTime(std::int64_t t_ns);
  void writeRow(const ClockRow& row);
  void flushRow();
  double offset_ns(std::int64_t t_ns, std::uint64_t frame) const;
  std::optional<double> leastOffset_ns() const;

  Sinks sinks_;
  std::uint64_t frames_ = 0, gaps_ = 0, segment_ = 0;
  std::vector<float> samples_;  ///< of the segment
  std::size_t stored_ = 0;      ///< of them, handed on
  std::vector<ClockRow> rows_;
  std::optional<ClockRow> earliest_;  ///< of the running tenth of a second
  std::uint64_t tenth_ = 0;
  bool is_overrun_ = false;
  std::vector<HeardBlock> held_;  ///< since an overrun
  std::uint64_t held_frames_ = 0;
  std::vector<float> newest_;  ///< a ring by frame
};

}  // namespace app
