#include "app/evaluation/voice/speech_watch.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace app {
namespace {

constexpr std::int64_t kFrame_ns = 10'000'000, kWait_ns = 200'000'000;
constexpr int kFramesOfLevel = 10;

}  // namespace

SpeechWatch::SpeechWatch(int played, Listeners listeners)
    : listeners_(std::move(listeners)), played_(played, kVoiceRate_Hz) {}

void SpeechWatch::add(const HeardBlock& block) {
  for (std::uint32_t n = 0; n < block.count; ++n) {
    filling_.samples[filled_++] = block.samples[n];
    if (filled_ < kVoiceFrame) continue;
    filled_ = 0;
    // Arrivals scatter: frames go on evenly while they are not far off.
    constexpr std::int64_t kFar_ns = 50'000'000;
    const std::int64_t even_ns = newest_ns_ + kFrame_ns;
    const bool is_far = newest_ns_ == 0 || std::abs(block.t_ns - even_ns) > kFar_ns;
    newest_ns_ = block.t_ns != 0 && is_far ? block.t_ns : even_ns;
    filling_.t_ns = newest_ns_;
    waiting_.push_back(filling_);
  }
  while (!waiting_.empty() && (!played_.isThere() || newest_ns_ - waiting_.front().t_ns >= kWait_ns)) {
    look(waiting_.front());
    waiting_.pop_front();
  }
}

void SpeechWatch::look(const Frame& frame) {
  std::array<float, kVoiceFrame> echo{};
  played_.read(frame.t_ns - kFrame_ns, echo);
  const bool is_voiced = detector_.isVoiced(frame.samples, echo);
  if (const auto change = judge_.add(is_voiced, frame.t_ns)) listeners_.speech(*change);
  measure(frame);
}

void SpeechWatch::measure(const Frame& frame) {
  for (const float sample : frame.samples) square_ += double{sample} * sample;
  if (++measured_ < kFramesOfLevel) return;
  constexpr double kLeast = 1e-10, kTenth_s = 0.1;
  const double mean = square_ / static_cast<double>(kFramesOfLevel * kVoiceFrame);
  const double level_db = 10.0 * std::log10(std::max(kLeast, mean));
  if (judge_.speaks()) {
    speech_s_ += kTenth_s;
    if (level_db >= kGreenFrom_db && level_db <= kGreenTo_db) green_s_ += kTenth_s;
  }
  square_ = 0.0, measured_ = 0;
  listeners_.level(frame.t_ns, level_db);
}

}  // namespace app
