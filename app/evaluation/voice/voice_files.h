// The files of a recorded voice, in the folder `voice` of a session: 000000.flac and on, 2 s each and whole in itself,
// with a study's keys 000000.flac.sealed (study/privacy), and clock.csv (clock_map). Segment n holds the samples from n
// * kSegmentFrames on; one that is not there is silence, the last may be shorter. One thread; milliseconds a segment.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/evaluation/voice/voice_recorder.h"
#include "app/study/privacy/sealing.h"

namespace app {

inline constexpr char kVoiceFolder[] = "voice", kVoiceClock[] = "clock.csv", kVoiceTicks[] = "ticks.csv";

inline constexpr std::size_t kMostClockBytes = 64U << 20U;  ///< two days

/// What segments are sealed with, each at its own place.
struct VoiceSeal {
  SecretKey key;
  std::string session;  ///< its folder's name

  std::string sealed(std::uint64_t number, std::string_view flac) const;
  std::optional<std::string> opened(std::uint64_t number, std::string_view sealed) const;
};
/// Table of the seal, beside the session's name and the segment's number.
inline constexpr char kVoiceTable[] = "voice";
/// Opens what is sealed; none: it stays closed.
using SegmentOpener = std::function<std::optional<std::string>(std::uint64_t number, std::string_view sealed)>;

std::string segmentName(std::uint64_t number, bool is_sealed = false);

/// Under a temporary name, then renamed. `seal` null: as it is. Throws CalibrationError: the disk refuses.
void storeSegment(const std::string& folder, std::uint64_t number, std::span<const float> samples,
                  const VoiceSeal* seal = nullptr);
/// None: there is none, or it cannot be read.
std::optional<std::vector<float>> loadSegment(const std::string& folder, std::uint64_t number,
                                              const SegmentOpener& opener = {});
/// Numbers of those that are there, in order.
std::vector<std::uint64_t> segmentsIn(const std::string& folder);

/// A folder that is recorded into: made, or as one that was killed has left it.
class VoiceFolder {
 public:
  /// `seal`: all is sealed with it. Throws CalibrationError: it cannot be written.
  explicit VoiceFolder(std::string path, std::optional<VoiceSeal> seal = {});
  ~VoiceFolder();
  VoiceFolder(const VoiceFolder&) = delete;
  VoiceFolder& operator=(const VoiceFolder&) = delete;

  VoicePast takePast() { return std::exchange(past_, {}); }
  /// Throws CalibrationError: the disk refuses.
  void store(std::uint64_t number, std::span<const float> samples) const;
  void add(const ClockRow& row) const;
  std::size_t segments() const { return segmentsIn(path_).size(); }

 private:
  void readPast(const std::string& clock);

  std::string path_;
  int clock_ = -1;
  std::optional<VoiceSeal> seal_;
  VoicePast past_;
};

}  // namespace app
