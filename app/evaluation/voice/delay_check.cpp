#include "app/evaluation/voice/delay_check.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <span>
#include <vector>

#include "app/evaluation/voice/chirp.h"
#include "app/evaluation/voice/speech_detector.h"
#include "app/sound/sound_card.h"

namespace app {
namespace {

constexpr double kNanoseconds = 1e9;
constexpr std::int64_t kWithin_ns = 1'000'000'000, kPatience_ns = 3'000'000'000;

std::int64_t steady_ns() { return std::chrono::steady_clock::now().time_since_epoch().count(); }

}  // namespace

struct DelayCheck::Player {
  /// On the card's thread: after 0.2 s of silence, so that the card has come up.
  void fill(std::span<float> samples) noexcept {
    const std::int64_t now_ns = steady_ns();
    for (std::size_t n = 0; n < samples.size(); ++n, ++next) {
      const bool sounds = next >= first && next - first < chirp.size();
      samples[n] = sounds ? chirp[next - first] : 0.0F;
      if (next == first)
        filled_ns.store(now_ns + static_cast<std::int64_t>(static_cast<double>(n) * kNanoseconds / rate_Hz));
    }
  }

  std::vector<float> chirp;
  double rate_Hz = kVoiceRate_Hz;
  std::size_t next = 0, first = 0;
  std::atomic<std::int64_t> filled_ns{0};
  std::unique_ptr<SoundCard> card;  ///< last: its thread uses the others
};

DelayCheck::DelayCheck() : player_(std::make_unique<Player>()), begun_ns_(steady_ns()) {
  Player& player = *player_;
  player.card = std::make_unique<SoundCard>(
      [&player](double rate_Hz) {
        constexpr double kBefore_s = 0.2;
        player.rate_Hz = rate_Hz;
        player.chirp = chirpAt(rate_Hz);
        player.first = static_cast<std::size_t>(kBefore_s * rate_Hz);
        return [&player](std::span<float> samples) { player.fill(samples); };
      },
      [](const std::string&) {});
  is_done_ = !player.card->isAvailable();
}

DelayCheck::~DelayCheck() = default;

void DelayCheck::follow(const VoiceRecorder& recorder, std::int64_t now_ns) {
  if (is_done_) return;
  const std::int64_t filled_ns = player_->filled_ns.load();
  const auto latency_ns = static_cast<std::int64_t>(player_->card->latency_s() * kNanoseconds);
  const bool is_heard = filled_ns != 0 && now_ns >= filled_ns + latency_ns + kWithin_ns;
  if (!is_heard && now_ns < begun_ns_ + kPatience_ns) return;
  is_done_ = true;
  if (is_heard) delay_ms_ = delayOfChirp_ms(recorder, filled_ns + latency_ns);
  player_.reset();
}

std::optional<double> delayOfChirp_ms(const VoiceRecorder& recorder, std::int64_t left_ns) {
  const ClockMap map = recorder.map();
  if (!map.isKnown()) return {};
  // A little before it: a card's own word on its delay may be too large.
  constexpr std::int64_t kBefore_ns = 50'000'000;
  constexpr std::size_t kLooked = kVoiceRate_Hz * 3 / 4;
  const auto first = static_cast<std::uint64_t>(std::max(0.0, map.frame(left_ns - kBefore_ns)));
  const auto found = findChirp(recorder.newest(first, kLooked), kVoiceRate_Hz);
  if (!found) return {};
  return static_cast<double>(map.t_ns(static_cast<double>(first + found->at)) - left_ns) / 1e6;
}

}  // namespace app
