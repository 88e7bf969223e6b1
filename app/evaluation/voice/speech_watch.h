// Blocks of a microphone in, what is to be told of them out: speech that begins and ends, the level, speech in the
// green. What is heard waits for 0.2 s, where something is played, until all that could be its echo is known. One
// thread; 0.1 ms of processor in 10 ms of sound.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>

#include "app/evaluation/voice/heard_block.h"
#include "app/evaluation/voice/speech_detector.h"
#include "app/evaluation/voice/speech_judge.h"
#include "app/sound/played_sound.h"

namespace app {

/// Level within which speech is recorded well, dB of full scale.
inline constexpr double kGreenFrom_db = -40.0, kGreenTo_db = -9.0;

class SpeechWatch {
 public:
  struct Listeners {
    std::function<void(const SpeechChange&)> speech;
    std::function<void(std::int64_t t_ns, double level_db)> level;  ///< each tenth of a second
  };
  /// `played`: descriptor of a PlayedSound, -1: nothing is played.
  SpeechWatch(int played, Listeners listeners);

  void add(const HeardBlock& block);
  /// Speech within the green level so far; all speech.
  double green_s() const { return green_s_; }
  double speech_s() const { return speech_s_; }

 private:
  struct Frame {
    std::array<float, kVoiceFrame> samples{};
    std::int64_t t_ns = 0;  ///< its end
  };
  void look(const Frame& frame);
  void measure(const Frame& frame);

  Listeners listeners_;
  SpeechDetector detector_;
  SpeechJudge judge_;
  PlayedSoundReader played_;
  Frame filling_;
  std::size_t filled_ = 0;
  std::int64_t newest_ns_ = 0;
  std::deque<Frame> waiting_;
  double square_ = 0.0, green_s_ = 0.0, speech_s_ = 0.0;
  int measured_ = 0;
};

}  // namespace app
