#include "app/debrief/debrief_voice.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <filesystem>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "app/debrief/voice_along.h"
#include "app/sound/sound_card.h"
#include "haptics/spsc_ring.h"

namespace app {
namespace {

constexpr std::size_t kPieces = 4096;

}  // namespace

struct DebriefVoice::Player {
  /// A run of samples; those of a former beginning are passed over.
  struct Piece {
    static constexpr std::size_t kMost = 64;
    std::array<float, kMost> samples{};
    std::uint32_t count = 0, beginning = 0;
  };

  Player(VoiceTrack&& voice, double tick_s) {
    taken.reserve(2 * kPieces);
    card.emplace(
        [&, this](double rate_Hz) {
          along.emplace(std::move(voice), tick_s, rate_Hz);
          return [this](std::span<float> samples) { fill(samples); };
        },
        [](const std::string&) {});
  }

  /// On the card's thread.
  void fill(std::span<float> samples) noexcept {
    std::ranges::fill(samples, 0.0F);
    const std::uint32_t wanted = beginning.load(std::memory_order_acquire);
    std::size_t done = 0;
    while (done < samples.size()) {
      if (next == taken.size()) {
        taken.clear();
        next = 0;
        ring.drainInto(taken);
        if (taken.empty()) break;
      }
      const Piece& piece = taken[next];
      const std::size_t count =
          piece.beginning == wanted ? std::min<std::size_t>(piece.count - at, samples.size() - done) : piece.count - at;
      if (piece.beginning == wanted) {
        std::copy_n(piece.samples.begin() + static_cast<std::ptrdiff_t>(at), count,
                    samples.begin() + static_cast<std::ptrdiff_t>(done));
        done += count;
      }
      at += count;
      played.fetch_add(count, std::memory_order_relaxed);
      if (at == piece.count) ++next, at = 0;
    }
  }

  void handOn(const VoiceAlong::Piece& piece) {
    if (piece.begins) {
      beginning.fetch_add(1, std::memory_order_release);
      before = handed;
    }
    for (std::size_t n = 0; n < piece.samples.size(); n += Piece::kMost) {
      Piece one;
      one.count = static_cast<std::uint32_t>(std::min(Piece::kMost, piece.samples.size() - n));
      one.beginning = beginning.load(std::memory_order_relaxed);
      std::copy_n(piece.samples.begin() + static_cast<std::ptrdiff_t>(n), one.count, one.samples.begin());
      ring.push(one);
      handed += one.count;
    }
  }
  /// Of those since the newest beginning.
  std::size_t waiting() const {
    return static_cast<std::size_t>(handed - std::clamp(played.load(std::memory_order_relaxed), before, handed));
  }

  haptics::SpscRing<Piece> ring{kPieces};
  std::optional<VoiceAlong> along;
  std::uint64_t handed = 0, before = 0;  ///< samples, all and before the newest beginning
  std::atomic<std::uint64_t> played{0};
  std::atomic<std::uint32_t> beginning{0};
  std::vector<Piece> taken;
  std::size_t next = 0, at = 0;
  std::optional<SoundCard> card;  ///< last: its thread uses the others
};

DebriefVoice::DebriefVoice(const std::string& recording, double tick_s, SegmentOpener opener) {
  const std::string folder = std::filesystem::path(recording).parent_path().string();
  auto track = VoiceTrack::of(folder, 1.0 / tick_s, std::move(opener));
  if (!track || track->frames() == 0) return;
  player_ = std::make_unique<Player>(std::move(*track), tick_s);
  if (!player_->card->isAvailable()) player_.reset();
}

DebriefVoice::~DebriefVoice() = default;

void DebriefVoice::follow(double position_s, bool plays_along, bool scrubs) {
  if (!player_) return;
  VoiceAlong& along = *player_->along;
  player_->handOn(scrubs ? along.grain(position_s) : along.next(position_s, plays_along, player_->waiting()));
}

}  // namespace app
