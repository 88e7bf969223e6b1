#include "app/debrief/voice_along.h"

#include <cmath>
#include <utility>

#include "app/evaluation/voice/speech_detector.h"

namespace app {
namespace {

constexpr double kAhead_s = 0.25, kFar_s = 0.03;

}  // namespace

VoiceAlong::VoiceAlong(VoiceTrack track, double tick_s, double rate_Hz)
    : track_(std::move(track)), tick_s_(tick_s), rate_Hz_(rate_Hz), step_(kVoiceRate_Hz / rate_Hz) {}

VoiceAlong::Piece VoiceAlong::next(double position_s, bool plays_along, std::size_t waiting) {
  Piece piece;
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
  piece.samples.resize(ahead - waiting);
  const double first = std::floor(next_);
  std::vector<float> heard_then(static_cast<std::size_t>(static_cast<double>(piece.samples.size()) * step_) + 3);
  track_.read(static_cast<std::int64_t>(first), heard_then);
  for (float& sample : piece.samples) {
    const double at = next_ - first, whole = std::floor(at);
    const auto index = static_cast<std::size_t>(whole);
    const float one = heard_then[index], other = heard_then[index + 1];
    sample = one + static_cast<float>(at - whole) * (other - one);
    next_ += step_;
  }
  return piece;
}

}  // namespace app
