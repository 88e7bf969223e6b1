#include "app/calibrate/sounds.h"

#include <array>
#include <atomic>
#include <cmath>
#include <span>

#include "app/sound/sound_card.h"
#include "calibration/geometry/units.h"

namespace app {
namespace {

constexpr double kLoudest = 0.25, kEdge_s = 0.008;

/// `buzz`: odd overtones, distinct from the other notes whatever the pitch.
struct Note {
  double pitch_Hz = 0.0, length_s = 0.0;
  bool buzz = false;
};

/// In the order of WizardSound.
constexpr std::array<std::array<Note, 4>, 4> kNotes{{{{{880.0, 0.09}}},
                                                     {{{150.0, 0.28, true}}},
                                                     {{{587.0, 0.06}, {784.0, 0.07}}},
                                                     {{{523.0, 0.12}, {659.0, 0.12}, {784.0, 0.12}, {1047.0, 0.25}}}}};

}  // namespace

std::vector<float> soundSamples(WizardSound sound, double rate_Hz) {
  std::vector<float> samples;
  for (const Note& note : kNotes[static_cast<std::size_t>(sound)]) {
    const auto count = static_cast<std::size_t>(note.length_s * rate_Hz);
    for (std::size_t n = 0; n < count; ++n) {
      const double t_s = static_cast<double>(n) / rate_Hz, left_s = static_cast<double>(count - 1 - n) / rate_Hz;
      const double swell = std::min({1.0, t_s / kEdge_s, left_s / kEdge_s});
      const double phase = 2.0 * calibration::kPi * note.pitch_Hz * t_s;
      double wave = std::sin(phase);
      if (note.buzz) wave = (wave + std::sin(3.0 * phase) / 1.5 + std::sin(5.0 * phase) / 2.5) / 1.6;
      samples.push_back(static_cast<float>(kLoudest * swell * wave));
    }
  }
  return samples;
}

struct Sounds::Player {
  static constexpr std::size_t kWaiting = 8;

  explicit Player(const std::function<void(const std::string&)>& report)
      : card([this](double rate_Hz) { return prepare(rate_Hz); },
             [&](const std::string& why) { report("sound: " + why + "; the wizard is silent, watch the ring"); }) {}

  SoundCard::Fill prepare(double rate_Hz) {
    for (std::size_t t = 0; t < samples_of.size(); ++t)
      samples_of[t] = soundSamples(static_cast<WizardSound>(t), rate_Hz);
    return [this](std::span<float> output) { fill(output); };
  }

  void fill(std::span<float> output) {
    for (float& sample : output) {
      const std::size_t played = played_count.load(std::memory_order_relaxed);
      if (played == queued_count.load(std::memory_order_acquire)) {
        sample = 0.0F;
        continue;
      }
      const std::vector<float>& wave = samples_of[static_cast<std::size_t>(queued[played % kWaiting])];
      sample = wave[at++];
      if (at < wave.size()) continue;
      at = 0;
      played_count.store(played + 1, std::memory_order_release);
    }
  }

  std::array<std::vector<float>, 4> samples_of;
  std::array<WizardSound, kWaiting> queued{};  ///< ring: written by the loop, read by the sound thread
  std::atomic<std::size_t> queued_count{0}, played_count{0};
  std::size_t at = 0;  ///< used by the sound thread
  SoundCard card;      ///< the last: it asks for sound from then on
};

Sounds::Sounds(const std::function<void(const std::string&)>& report) : player_(std::make_unique<Player>(report)) {}
Sounds::~Sounds() = default;

bool Sounds::isAvailable() const { return player_->card.isAvailable(); }

void Sounds::play(WizardSound sound) {
  if (!isAvailable()) return;
  const std::size_t queued = player_->queued_count.load(std::memory_order_relaxed);
  if (queued - player_->played_count.load(std::memory_order_acquire) >= Player::kWaiting) return;
  player_->queued[queued % Player::kWaiting] = sound;
  player_->queued_count.store(queued + 1, std::memory_order_release);
}

}  // namespace app
