#include "app/evaluation/voice/voice_files.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include <fmt/core.h>

#include "app/evaluation/voice/speech_detector.h"
#include "app/sound/flac_piece.h"
#include "app/text/parse_number.h"
#include "assets/load_error.h"
#include "assets/toml_reader.h"
#include "calibration/calibration_error.h"
#include "calibration/output_file.h"

namespace app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostBytes = 4U * kSegmentFrames, kDigits = 6;
constexpr std::string_view kEnding = ".flac", kSealedEnding = ".sealed";

std::string pathOf(const std::string& folder, std::uint64_t number, bool is_sealed) {
  return (fs::path(folder) / segmentName(number, is_sealed)).string();
}

std::string openedSegment(const std::string& path, std::uint64_t number, const SegmentOpener& opener) {
  const std::string bytes = assets::readSmallFile(path, kMostBytes);
  return opener ? opener(number, bytes).value_or("") : "";
}

}  // namespace

std::string VoiceSeal::sealed(std::uint64_t number, std::string_view flac) const {
  return sealedWith(key, {session, kVoiceTable, number}, flac);
}

std::optional<std::string> VoiceSeal::opened(std::uint64_t number, std::string_view sealed) const {
  return openedWith(key, {session, kVoiceTable, number}, sealed);
}

std::string segmentName(std::uint64_t number, bool is_sealed) {
  return fmt::format("{:06}{}{}", number, kEnding, is_sealed ? kSealedEnding : "");
}

void storeSegment(const std::string& folder, std::uint64_t number, std::span<const float> samples,
                  const VoiceSeal* seal) {
  calibration::OutputFile file(pathOf(folder, number, seal != nullptr), true);
  const std::string flac = flacOf(samples, kVoiceRate_Hz);
  file.commit(seal != nullptr ? seal->sealed(number, flac) : flac);
}

std::optional<std::vector<float>> loadSegment(const std::string& folder, std::uint64_t number,
                                              const SegmentOpener& opener) {
  std::error_code failed;
  try {
    if (const std::string path = pathOf(folder, number, false); fs::is_regular_file(path, failed))
      return soundOfFlac(assets::readSmallFile(path, kMostBytes), kVoiceRate_Hz, kSegmentFrames);
    if (const std::string path = pathOf(folder, number, true); fs::is_regular_file(path, failed))
      return soundOfFlac(openedSegment(path, number, opener), kVoiceRate_Hz, kSegmentFrames);
    return {};
  } catch (const assets::LoadError&) {
    return {};
  }
}

std::vector<std::uint64_t> segmentsIn(const std::string& folder) {
  std::vector<std::uint64_t> numbers;
  std::error_code failed;
  for (fs::directory_iterator at(folder, failed), end; !failed && at != end; at.increment(failed)) {
    std::string name = at->path().filename().string();
    if (name.ends_with(kSealedEnding)) name.resize(name.size() - kSealedEnding.size());
    if (!name.ends_with(kEnding)) continue;
    const auto number = parseNumber<std::uint64_t>(std::string_view(name).substr(0, name.size() - kEnding.size()));
    if (number && name.size() >= kDigits + kEnding.size() && segmentName(*number) == name) numbers.push_back(*number);
  }
  std::ranges::sort(numbers);
  return numbers;
}

VoiceFolder::VoiceFolder(std::string path, std::optional<VoiceSeal> seal)
    : path_(std::move(path)), seal_(std::move(seal)) {
  std::error_code failed;
  fs::create_directory(path_, failed);
  fs::permissions(path_, fs::perms::owner_all, failed);
  const std::string clock = (fs::path(path_) / kVoiceClock).string();
  const bool is_there = fs::exists(clock, failed);
  if (is_there) readPast(clock);
  constexpr mode_t kOwnerAlone = 0600;
  clock_ = ::open(clock.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, kOwnerAlone);
  if (clock_ < 0 || (!is_there && ::write(clock_, kClockHeader.data(), kClockHeader.size()) < 0))
    throw calibration::CalibrationError(clock + ": cannot be written, give another folder");
}

VoiceFolder::~VoiceFolder() {
  if (clock_ >= 0) ::close(clock_);
}

/// Whole segments, and rows of which the last may be cut off; those of what was not stored any more are left out.
void VoiceFolder::readPast(const std::string& clock) {
  const std::string text = assets::readSmallFile(clock, kMostClockBytes);
  past_.rows = clockRowsFrom(text).value_or(std::vector<ClockRow>());
  if (const std::vector<std::uint64_t> segments = segmentsIn(path_); !segments.empty()) {
    past_.segment = segments.back();
    past_.samples = loadSegment(path_, past_.segment, [this](std::uint64_t number, std::string_view sealed) {
                      return seal_ ? seal_->opened(number, sealed) : std::nullopt;
                    }).value_or(std::vector<float>());
  }
  const std::uint64_t frames = past_.segment * kSegmentFrames + past_.samples.size();
  std::erase_if(past_.rows, [frames](const ClockRow& row) { return row.frame > frames; });
  std::string kept(kClockHeader);
  for (const ClockRow& row : past_.rows) kept += clockLine(row);
  if (kept != text) calibration::OutputFile(clock, true).commit(kept);
}

void VoiceFolder::store(std::uint64_t number, std::span<const float> samples) const {
  storeSegment(path_, number, samples, seal_ ? &*seal_ : nullptr);
  ::fdatasync(clock_);
}

void VoiceFolder::add(const ClockRow& row) const {
  const std::string line = clockLine(row);
  if (::write(clock_, line.data(), line.size()) != static_cast<ssize_t>(line.size()))
    throw calibration::CalibrationError(path_ + ": the voice cannot be written any more, make room on the disk");
}

}  // namespace app
