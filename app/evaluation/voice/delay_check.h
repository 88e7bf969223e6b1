// The constant delay from a sound at the card to its sample in the recording, once: a chirp is played whose time is
// known, and found. Without a sound card, or where nothing of it is heard, there is none. Construction takes up to a
// second while cards are searched. One thread; the card has its own.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "app/evaluation/voice/voice_recorder.h"

namespace app {

class DelayCheck {
 public:
  DelayCheck();
  ~DelayCheck();
  DelayCheck(const DelayCheck&) = delete;
  DelayCheck& operator=(const DelayCheck&) = delete;

  /// There is nothing to wait for any more: it was found, or not within a second of its sound.
  bool isDone() const { return is_done_; }
  std::optional<double> delay_ms() const { return delay_ms_; }
  void follow(const VoiceRecorder& recorder, std::int64_t now_ns);

 private:
  struct Player;
  std::unique_ptr<Player> player_;
  std::int64_t begun_ns_;
  bool is_done_ = false;
  std::optional<double> delay_ms_;
};

/// In a recording that holds a chirp which left the card then. None: it is not found.
std::optional<double> delayOfChirp_ms(const VoiceRecorder& recorder, std::int64_t left_ns);

}  // namespace app
