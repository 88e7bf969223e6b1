#include "app/evaluation/voice/voice_track.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "app/evaluation/voice/speech_detector.h"
#include "app/evaluation/voice/voice_files.h"
#include "assets/load_error.h"
#include "assets/toml_reader.h"

namespace app {
namespace {

namespace fs = std::filesystem;

std::vector<ClockRow> rowsOf(const fs::path& path) {
  auto rows = clockRowsFrom(assets::readSmallFile(path.string(), kMostClockBytes));
  if (!rows) throw assets::LoadError(path.string() + ": is no clock of a voice, take it from a copy");
  return std::move(*rows);
}

}  // namespace

std::optional<VoiceTrack> VoiceTrack::of(const std::string& session, double tick_rate_Hz, SegmentOpener opener) {
  const fs::path folder = fs::path(session) / kVoiceFolder;
  std::error_code failed;
  if (!fs::is_regular_file(folder / kVoiceClock, failed)) return {};
  const std::vector<ClockRow> rows = rowsOf(folder / kVoiceClock);
  std::vector<ClockRow> ticks;
  if (fs::is_regular_file(folder / kVoiceTicks, failed)) ticks = rowsOf(folder / kVoiceTicks);
  return VoiceTrack(folder.string(), rows, ticks, tick_rate_Hz, std::move(opener));
}

VoiceTrack::VoiceTrack(std::string folder, std::span<const ClockRow> rows, std::span<const ClockRow> ticks,
                       double tick_rate_Hz, SegmentOpener opener)
    : folder_(std::move(folder)), opener_(std::move(opener)), map_(rows, kVoiceRate_Hz), ticks_(ticks, tick_rate_Hz) {
  const std::vector<std::uint64_t> segments = segmentsIn(folder_);
  if (segments.empty()) return;
  load(segments.back());
  frames_ = static_cast<std::int64_t>(segments.back() * kSegmentFrames + segment_.size());
}

void VoiceTrack::load(std::uint64_t number) {
  if (loaded_ == number) return;
  segment_ = loadSegment(folder_, number, opener_).value_or(std::vector<float>());
  loaded_ = number;
}

void VoiceTrack::read(std::int64_t first, std::span<float> out) {
  std::ranges::fill(out, 0.0F);
  for (std::size_t n = 0; n < out.size();) {
    const std::int64_t frame = first + static_cast<std::int64_t>(n);
    if (frame < 0) {
      ++n;
      continue;
    }
    const auto number = static_cast<std::uint64_t>(frame) / kSegmentFrames;
    const auto from = static_cast<std::size_t>(static_cast<std::uint64_t>(frame) % kSegmentFrames);
    const std::size_t count = std::min(kSegmentFrames - from, out.size() - n);
    if (frame < frames_) {
      load(number);
      const std::size_t there = std::min(count, segment_.size() - std::min(from, segment_.size()));
      std::copy_n(segment_.begin() + static_cast<std::ptrdiff_t>(std::min(from, segment_.size())), there,
                  out.begin() + static_cast<std::ptrdiff_t>(n));
    }
    n += count;
  }
}

std::int64_t VoiceTrack::frameAt(std::int64_t t_ns) const { return std::llround(map_.frame(t_ns)); }

std::optional<std::int64_t> VoiceTrack::timeOfTick(double tick) const {
  if (!ticks_.isKnown()) return {};
  return ticks_.t_ns(tick);
}

}  // namespace app
