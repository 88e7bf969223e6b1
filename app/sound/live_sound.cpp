#include "app/sound/live_sound.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "app/sound/sound_card.h"
#include "haptics/spsc_ring.h"

namespace app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kPiece_s = 0.004;        ///< ticks in one control
constexpr std::size_t kWaiting = 512;     ///< controls, two seconds
constexpr std::size_t kMostWaiting = 15;  ///< more than 60 ms behind: it catches up
constexpr std::size_t kKept = 5;          ///< to 20 ms
constexpr double kSilentAfter_s = 0.3;    ///< without a tick

}  // namespace

struct LiveSound::Player {
  struct Piece {
    SoundControl control;
    Clock::time_point taken{};  ///< by the frame, from the servo
  };

  explicit Player(PlayedSound* heard_by) : played(heard_by), pieces(kWaiting) {
    waiting.reserve(2 * kWaiting);  // half of it, and all that a full ring holds
    search = std::thread([this] {
      auto found = std::make_unique<SoundCard>([this](double rate_Hz) { return prepare(rate_Hz); },
                                               [this](const std::string& why) {
                                                 const std::scoped_lock lock(mutex);
                                                 trouble = "sound: " + why + "; the rehearsal is silent";
                                               });
      const std::scoped_lock lock(mutex);
      card = std::move(found);
    });
  }
  ~Player() { search.join(); }
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;

  SoundCard::Fill prepare(double rate_Hz) {
    synth.emplace(rate_Hz);
    return [this](std::span<float> samples) { fill(samples); };
  }

  /// On the card's thread.
  void fill(std::span<float> samples) {
    const std::span<const float> all = samples;
    if (next == waiting.size()) waiting.clear(), next = 0;
    if (waiting.size() < waiting.capacity() / 2) pieces.drainInto(waiting);
    if (waiting.size() - next > kMostWaiting) next = waiting.size() - kKept;
    while (!samples.empty()) {
      if (left == 0) takeNext();
      const std::size_t count = std::min(left, samples.size());
      synth->render(current.control, samples.first(count));
      current.control.crack_Nmm = 0.0;
      current.control.fibres = 0;
      left -= count;
      if (muted.load(std::memory_order_relaxed)) std::ranges::fill(samples.first(count), 0.0F);
      samples = samples.subspan(count);
    }
    if (played != nullptr) played->add(all, synth->rate_Hz(), Clock::now().time_since_epoch().count());
  }

  void takeNext() {
    left = std::max<std::size_t>(1, static_cast<std::size_t>(kPiece_s * synth->rate_Hz()));
    if (next < waiting.size()) {
      current = waiting[next++];
      dry_s = 0.0;
      waited_us.fetch_add(std::chrono::duration_cast<std::chrono::microseconds>(Clock::now() - current.taken).count(),
                          std::memory_order_relaxed);
      heard.fetch_add(1, std::memory_order_relaxed);
      return;
    }
    dry_s += kPiece_s;
    if (dry_s > kSilentAfter_s) current.control = {};
  }

  PlayedSound* played;
  haptics::SpscRing<Piece> pieces;
  // Main thread.
  SoundScore score;
  SoundControl gathered;
  double gathered_s = 0.0;
  // The card's thread.
  std::optional<WorkSound> synth;
  std::vector<Piece> waiting;
  std::size_t next = 0, left = 0;
  Piece current;
  double dry_s = 0.0;
  // Between them.
  std::atomic<bool> muted{false};
  std::atomic<std::int64_t> waited_us{0}, heard{0};
  std::mutex mutex;  ///< of the two below; never taken on the card's thread
  std::string trouble;
  std::unique_ptr<SoundCard> card;
  std::thread search;
};

LiveSound::LiveSound(PlayedSound* played) : player_(std::make_unique<Player>(played)) {}
LiveSound::~LiveSound() = default;

void LiveSound::follow(std::span<const haptics::Tick> ticks, const haptics::Command& in_force,
                       const SoundWarning& warning) {
  Player& player = *player_;
  for (const haptics::Tick& tick : ticks) {
    SoundControl control = player.score.of(tick, in_force);
    if (tick.drilling && control.warning.alarm == SoundAlarm::none) control.warning = warning;
    control.warning.apex = warning.apex;
    const SoundControl before = player.gathered;
    player.gathered = control;
    player.gathered.cut = std::max(control.cut, before.cut);
    player.gathered.crack_Nmm = std::max(control.crack_Nmm, before.crack_Nmm);
    player.gathered.fibres = std::min(8, control.fibres + before.fibres);
    player.gathered_s += tick.dt_s;
    if (player.gathered_s < kPiece_s - 1e-9) continue;
    player.pieces.push({player.gathered, Clock::now()});
    player.gathered = {};
    player.gathered_s = 0.0;
  }
}

void LiveSound::mute(bool muted) { player_->muted.store(muted, std::memory_order_relaxed); }
bool LiveSound::isMuted() const { return player_->muted.load(std::memory_order_relaxed); }

std::string LiveSound::takeTrouble() {
  const std::scoped_lock lock(player_->mutex);
  return std::exchange(player_->trouble, {});
}

std::string LiveSound::latencyText() const {
  const std::scoped_lock lock(player_->mutex);
  const auto heard = static_cast<double>(player_->heard.load(std::memory_order_relaxed));
  if (heard == 0.0 || !player_->card || !player_->card->isAvailable()) return "";
  const double card_ms = 1e3 * player_->card->latency_s();
  const double waited_ms = 1e-3 * static_cast<double>(player_->waited_us.load(std::memory_order_relaxed)) / heard;
  return fmt::format("sound: {:.0f} ms from the frame to the ear, {:.0f} ms of them in the card", waited_ms + card_ms,
                     card_ms);
}

}  // namespace app
