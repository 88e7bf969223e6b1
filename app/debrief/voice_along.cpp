#include "app/debrief/voice_along.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/evaluation/voice/speech_detector.h"

namespace app {
namespace {

constexpr double kAhead_s = 0.25, kFar_s = 0.03, kFade_s = 0.005;

}  // namespace

VoiceAlong::VoiceAlong(VoiceTrack track, double tick_s, double rate_Hz)
    : track_(std::move(track)), tick_s_(tick_s), rate_Hz_(rate_Hz), step_(kVoiceRate_Hz / rate_Hz) {}

VoiceAlong::Piece VoiceAlong::next(double position_s, bool plays_along, std::size_t waiting) {
  Piece piece;
  grain_s_.reset();
  const auto t_ns = plays_along ? track_.timeOfTick(position_s / tick_s_) : std::nullopt;
  if (!t_ns) {
    piece.begins = std::exchange(is_on_, false);
    return piece;
  }
  const auto wanted = static_cast<double>(track_.frameAt(*t_ns));
  const double heard = next_ - static_cast<double>(waiting) * step_;
  if (!is_on_ || std::abs(heard - wanted) > kFar_s * kVoiceRate_Hz) {
    is_on_ = piece.begins = true;
    next_ = wanted;
    waiting = 0;
  }
  const auto ahead = static_cast<std::size_t>(kAhead_s * rate_Hz_);
  if (waiting >= ahead) return piece;
  piece.samples = samplesFrom(next_, ahead - waiting);
  return piece;
}

/// `at`, of the track, goes on by as much.
std::vector<float> VoiceAlong::samplesFrom(double& at, std::size_t count) {
  std::vector<float> samples(count);
  const double first = std::floor(at);
  std::vector<float> heard_then(static_cast<std::size_t>(static_cast<double>(count) * step_) + 3);
  track_.read(static_cast<std::int64_t>(first), heard_then);
  for (float& sample : samples) {
    const double from = at - first, whole = std::floor(from);
    const auto index = static_cast<std::size_t>(whole);
    const float one = heard_then[index], other = heard_then[index + 1];
    sample = one + static_cast<float>(from - whole) * (other - one);
    at += step_;
  }
  return samples;
}

VoiceAlong::Piece VoiceAlong::grain(double position_s) {
  Piece piece;
  if (grain_s_ == position_s) return piece;
  grain_s_ = position_s;
  is_on_ = false;
  piece.begins = true;
  const auto t_ns = track_.timeOfTick(position_s / tick_s_);
  if (!t_ns) return piece;
  auto at = static_cast<double>(track_.frameAt(*t_ns));
  piece.samples = samplesFrom(at, static_cast<std::size_t>(kGrain_s * rate_Hz_));
  // Cut off it would click.
  const auto faded = std::min(static_cast<std::size_t>(kFade_s * rate_Hz_), piece.samples.size() / 2);
  for (std::size_t n = 0; n < faded; ++n) {
    const float share = static_cast<float>(n) / static_cast<float>(faded);
    piece.samples[n] *= share;
    piece.samples[piece.samples.size() - 1 - n] *= share;
  }
  return piece;
}

}  // namespace app
