#include "app/evaluation/voice/speech_judge.h"

#include <algorithm>

namespace app {
namespace {

constexpr std::size_t kEnough = 15;  ///< 30 % of 0.5 s
constexpr std::int64_t kPause_ns = 1'000'000'000;
constexpr double kPerNano = 1e-9, kAgain_s = 60.0;

}  // namespace

std::optional<SpeechChange> SpeechJudge::add(bool is_voiced, std::int64_t t_ns) {
  voiced_ = voiced_ + (is_voiced ? 1U : 0U) - (window_[next_] ? 1U : 0U);
  window_[next_] = is_voiced;
  next_ = (next_ + 1) % window_.size();
  if (voiced_ >= kEnough) {
    spoke_ns_ = t_ns;
    if (speaks_) return {};
    speaks_ = true;
    return SpeechChange{t_ns, true};
  }
  if (!speaks_ || t_ns - spoke_ns_ < kPause_ns) return {};
  speaks_ = false;
  return SpeechChange{spoke_ns_, false};
}

void QuietWatch::begin(std::int64_t now_ns) {
  since_ns_ = now_ns;
  reminded_ns_.reset();
}

void QuietWatch::follow(const SpeechChange& change) {
  speaks_ = change.speaks;
  since_ns_ = std::max(since_ns_, change.t_ns);
  reminded_ns_.reset();
}

bool QuietWatch::isDue(std::int64_t now_ns) {
  if (quiet_s(now_ns) < silence_s_) return false;
  if (reminded_ns_ && static_cast<double>(now_ns - *reminded_ns_) * kPerNano < kAgain_s) return false;
  reminded_ns_ = now_ns;
  return true;
}

double QuietWatch::quiet_s(std::int64_t now_ns) const {
  return speaks_ ? 0.0 : std::max(0.0, static_cast<double>(now_ns - since_ns_) * kPerNano);
}

}  // namespace app
