#include "app/sound/sound_card.h"

#include <portaudio.h>

#include "app/sound/silence_libraries.h"

namespace app {

struct SoundCard::Stream {
  Stream(const std::function<Fill(double)>& make, const std::function<void(const std::string&)>& report) {
    silenceSoundLibraries();
    PaError error = Pa_Initialize();
    is_initialised = error == paNoError;
    const PaDeviceIndex device = is_initialised ? Pa_GetDefaultOutputDevice() : paNoDevice;
    if (is_initialised && device == paNoDevice) error = paDeviceUnavailable;
    if (error == paNoError) {
      const PaDeviceInfo* card = Pa_GetDeviceInfo(device);
      const double rate_Hz = card != nullptr && card->defaultSampleRate > 0.0 ? card->defaultSampleRate : 48'000.0;
      fill = make(rate_Hz);
      PaStreamParameters output{};
      output.device = device;
      output.channelCount = 1;
      output.sampleFormat = paFloat32;
      output.suggestedLatency = card != nullptr ? card->defaultLowOutputLatency : 0.01;
      error =
          Pa_OpenStream(&stream, nullptr, &output, rate_Hz, paFramesPerBufferUnspecified, paNoFlag, fillBuffer, this);
    }
    if (error == paNoError) error = Pa_StartStream(stream);
    if (error == paNoError) return;
    end();
    report(error == paDeviceUnavailable ? "no sound card" : Pa_GetErrorText(error));
  }
  ~Stream() { end(); }
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;

  void end() {
    if (stream != nullptr) Pa_CloseStream(stream);
    stream = nullptr;
    if (is_initialised) Pa_Terminate();
    is_initialised = false;
  }

  static int fillBuffer(const void*, void* output, unsigned long frames, const PaStreamCallbackTimeInfo*,
                        PaStreamCallbackFlags, void* self) {
    static_cast<Stream*>(self)->fill(std::span(static_cast<float*>(output), frames));
    return paContinue;
  }

  Fill fill;
  PaStream* stream = nullptr;
  bool is_initialised = false;
};

SoundCard::SoundCard(const std::function<Fill(double)>& make, const std::function<void(const std::string&)>& report)
    : stream_(std::make_unique<Stream>(make, report)) {}
SoundCard::~SoundCard() = default;

bool SoundCard::isAvailable() const { return stream_->stream != nullptr; }

double SoundCard::latency_s() const {
  const PaStreamInfo* info = isAvailable() ? Pa_GetStreamInfo(stream_->stream) : nullptr;
  return info != nullptr ? info->outputLatency : 0.0;
}

}  // namespace app
