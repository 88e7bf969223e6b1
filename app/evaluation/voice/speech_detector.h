// Whether somebody speaks, 10 ms by 10 ms: WebRTC's detector of voice behind its echo canceller, which is given what
// the program itself plays, so that a drill is no speech (without it 41 to 72 % of a drill's frames count as voice).
// One thread; 0.1 ms of processor a call, memory is allocated in construction and in the first calls.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

namespace app {

inline constexpr int kVoiceRate_Hz = 48'000;
inline constexpr std::size_t kVoiceFrame = 480;  ///< samples in 10 ms

class SpeechDetector {
 public:
  SpeechDetector();
  ~SpeechDetector();
  SpeechDetector(const SpeechDetector&) = delete;
  SpeechDetector& operator=(const SpeechDetector&) = delete;

  /// kVoiceFrame samples of each, -1..1: what the microphone heard, and what was handed to the card in the same 10 ms.
  bool isVoiced(std::span<const float> heard, std::span<const float> played);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace app
