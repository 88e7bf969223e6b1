#include "app/evaluation/voice/speech_detector.h"

#include <webrtc/common.h>
#include <webrtc/modules/audio_processing/include/audio_processing.h>

#include <array>

namespace app {

struct SpeechDetector::Parts {
  std::unique_ptr<webrtc::AudioProcessing> audio;
  std::array<float, kVoiceFrame> cleaned{}, echo{};
};

SpeechDetector::SpeechDetector() : parts_(std::make_unique<Parts>()) {
  webrtc::Config config;
  // The delay from the card to the microphone is not known: it is searched for.
  config.Set<webrtc::DelayAgnostic>(new webrtc::DelayAgnostic(true));
  config.Set<webrtc::ExtendedFilter>(new webrtc::ExtendedFilter(true));
  parts_->audio.reset(webrtc::AudioProcessing::Create(config));
  webrtc::AudioProcessing& audio = *parts_->audio;
  audio.high_pass_filter()->Enable(true);
  audio.echo_cancellation()->Enable(true);
  audio.echo_cancellation()->set_suppression_level(webrtc::EchoCancellation::kHighSuppression);
  audio.voice_detection()->Enable(true);
  audio.voice_detection()->set_likelihood(webrtc::VoiceDetection::kVeryLowLikelihood);
}

SpeechDetector::~SpeechDetector() = default;

bool SpeechDetector::isVoiced(std::span<const float> heard, std::span<const float> played) {
  webrtc::AudioProcessing& audio = *parts_->audio;
  const webrtc::StreamConfig mono(kVoiceRate_Hz, 1);
  const float* const far_end = played.data();
  float* const echo = parts_->echo.data();
  audio.ProcessReverseStream(&far_end, mono, mono, &echo);
  audio.set_stream_delay_ms(0);
  const float* const near_end = heard.data();
  float* const cleaned = parts_->cleaned.data();
  audio.ProcessStream(&near_end, mono, mono, &cleaned);
  return audio.voice_detection()->stream_has_voice();
}

}  // namespace app
