#include "app/evaluation/voice/voice_recorder.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/evaluation/voice/speech_detector.h"

namespace app {
namespace {

constexpr double kSample_ns = 1e9 / kVoiceRate_Hz;
constexpr std::size_t kStoredEvery = kSegmentFrames / 2, kNewest = 4 * kVoiceRate_Hz;
constexpr std::uint64_t kTenth = kVoiceRate_Hz / 10, kHeldOnOverrun = kVoiceRate_Hz / 2;

}  // namespace

VoiceRecorder::VoiceRecorder(Sinks sinks, VoicePast past)
    : sinks_(std::move(sinks)),
      segment_(past.segment),
      samples_(std::move(past.samples)),
      stored_(samples_.size()),
      rows_(std::move(past.rows)),
      newest_(kNewest) {
  samples_.reserve(kSegmentFrames);
  frames_ = segment_ * kSegmentFrames + samples_.size();
  if (samples_.size() == kSegmentFrames) nextSegment();
  for (const ClockRow& row : rows_) gaps_ += row.gap_frames > 0 ? 1U : 0U;
  is_overrun_ = !rows_.empty();
}

double VoiceRecorder::offset_ns(std::int64_t t_ns, std::uint64_t frame) const {
  const std::int64_t origin_ns = rows_.empty() ? t_ns : rows_.front().t_ns;
  return static_cast<double>(t_ns - origin_ns) - static_cast<double>(frame) * kSample_ns;
}

/// Of the newest 10 s of rows; also across a gap, of which the length was told so.
std::optional<double> VoiceRecorder::leastOffset_ns() const {
  constexpr std::size_t kRows = 100;
  std::optional<double> least;
  const std::size_t first = rows_.size() > kRows ? rows_.size() - kRows : 0;
  for (std::size_t n = first; n < rows_.size(); ++n) {
    if (rows_[n].gap_frames > 0) continue;
    const double offset = offset_ns(rows_[n].t_ns, rows_[n].frame);
    if (!least || offset < *least) least = offset;
  }
  return least;
}

void VoiceRecorder::add(const HeardBlock& block) {
  is_overrun_ = is_overrun_ || block.overrun;
  if (!is_overrun_) return append(block);
  held_.push_back(block);
  held_frames_ += block.count + block.lost;
  if (held_frames_ >= kHeldOnOverrun) resolveOverrun();
}

void VoiceRecorder::resolveOverrun() {
  is_overrun_ = false;
  flushRow();
  std::uint64_t frame = frames_;
  std::optional<double> least;
  std::int64_t first_ns = 0;
  for (const HeardBlock& block : held_) {
    frame += block.count + block.lost;
    if (block.t_ns == 0) continue;
    if (first_ns == 0) first_ns = block.t_ns;
    const double offset = offset_ns(block.t_ns, frame);
    if (!least || offset < *least) least = offset;
  }
  const auto before = leastOffset_ns();
  if (least && before && first_ns != 0) {
    constexpr double kLongest = 24.0 * 3600.0 * kVoiceRate_Hz;
    const double lost = std::clamp(std::round((*least - *before) / kSample_ns), 0.0, kLongest);
    // Also where none seem to be missing: the map begins anew.
    addGap(std::max<std::uint64_t>(1, static_cast<std::uint64_t>(lost)), first_ns);
  }
  for (const HeardBlock& one : held_) append(one);
  held_.clear();
  held_frames_ = 0;
}

void VoiceRecorder::append(const HeardBlock& block) {
  if (block.lost > 0) {
    flushRow();
    addGap(block.lost, block.t_ns != 0 ? block.t_ns : rows_.empty() ? 0 : rows_.back().t_ns);
  }
  for (std::uint32_t n = 0; n < block.count; ++n) addSample(block.samples[n]);
  if (block.t_ns != 0) keepTime(block.t_ns);
}

void VoiceRecorder::addGap(std::uint64_t count, std::int64_t t_ns) {
  writeRow({frames_, t_ns, count});
  ++gaps_;
  appendSilence(count);
}

/// A segment of nothing else is left out.
void VoiceRecorder::appendSilence(std::uint64_t count) {
  while (count > 0) {
    if (samples_.empty() && count >= kSegmentFrames) {
      frames_ += kSegmentFrames, count -= kSegmentFrames, ++segment_;
      std::ranges::fill(newest_, 0.0F);
      continue;
    }
    addSample(0.0F);
    --count;
  }
}

void VoiceRecorder::addSample(float sample) {
  newest_[frames_ % kNewest] = sample;
  ++frames_;
  samples_.push_back(sample);
  if (samples_.size() % kStoredEvery != 0) return;
  sinks_.segment(segment_, samples_);
  stored_ = samples_.size();
  if (samples_.size() == kSegmentFrames) nextSegment();
}

void VoiceRecorder::nextSegment() {
  samples_.clear();
  stored_ = 0;
  ++segment_;
}

void VoiceRecorder::keepTime(std::int64_t t_ns) {
  if (frames_ / kTenth != tenth_) flushRow();
  tenth_ = frames_ / kTenth;
  if (!earliest_ || offset_ns(t_ns, frames_) < offset_ns(earliest_->t_ns, earliest_->frame))
    earliest_ = ClockRow{frames_, t_ns, 0};
}

void VoiceRecorder::flushRow() {
  if (earliest_) writeRow(*earliest_);
  earliest_.reset();
}

void VoiceRecorder::writeRow(const ClockRow& row) {
  sinks_.row(row);
  rows_.push_back(row);
}

void VoiceRecorder::finish() {
  if (!held_.empty()) resolveOverrun();
  flushRow();
  if (stored_ < samples_.size()) sinks_.segment(segment_, samples_);
  stored_ = samples_.size();
}

ClockMap VoiceRecorder::map() const { return {rows_, kVoiceRate_Hz}; }

std::vector<float> VoiceRecorder::newest(std::uint64_t first, std::size_t count) const {
  std::vector<float> found(count, 0.0F);
  for (std::size_t n = 0; n < count; ++n)
    if (const std::uint64_t frame = first + n; frame < frames_ && frame + kNewest >= frames_)
      found[n] = newest_[frame % kNewest];
  return found;
}

}  // namespace app
