#include "app/sound/sound_input.h"

#include <portaudio.h>

#include <utility>

#include "app/sound/silence_libraries.h"

namespace app {

struct SoundInput::Stream {
  Stream(double rate_Hz, Take takes, const std::function<void(const std::string&)>& report) : take(std::move(takes)) {
    silenceSoundLibraries();
    PaError error = Pa_Initialize();
    is_initialised = error == paNoError;
    const PaDeviceIndex device = is_initialised ? Pa_GetDefaultInputDevice() : paNoDevice;
    if (is_initialised && device == paNoDevice) error = paDeviceUnavailable;
    if (error == paNoError) {
      const PaDeviceInfo* card = Pa_GetDeviceInfo(device);
      PaStreamParameters input{};
      input.device = device;
      input.channelCount = 1;
      input.sampleFormat = paFloat32;
      // Nobody waits for it: rather late than with gaps.
      input.suggestedLatency = card != nullptr ? card->defaultHighInputLatency : 0.1;
      error =
          Pa_OpenStream(&stream, &input, nullptr, rate_Hz, paFramesPerBufferUnspecified, paNoFlag, takeBuffer, this);
    }
    if (error == paNoError) error = Pa_StartStream(stream);
    if (error == paNoError) return;
    end();
    report(error == paDeviceUnavailable ? "there is no microphone" : Pa_GetErrorText(error));
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

  static int takeBuffer(const void* input, void*, unsigned long frames, const PaStreamCallbackTimeInfo*,
                        PaStreamCallbackFlags flags, void* self) {
    if (input != nullptr)
      static_cast<Stream*>(self)->take(std::span(static_cast<const float*>(input), frames),
                                       (flags & paInputOverflow) != 0);
    return paContinue;
  }

  Take take;
  PaStream* stream = nullptr;
  bool is_initialised = false;
};

SoundInput::SoundInput(double rate_Hz, Take take, const std::function<void(const std::string&)>& report)
    : stream_(std::make_unique<Stream>(rate_Hz, std::move(take), report)) {}
SoundInput::~SoundInput() = default;

bool SoundInput::isAvailable() const { return stream_->stream != nullptr; }

}  // namespace app
