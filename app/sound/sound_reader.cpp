#include "app/sound/sound_reader.h"

#include <sndfile.h>

#include <algorithm>
#include <vector>

#include "app/text/usage_error.h"

namespace app {

struct SoundReader::Handle {
  SNDFILE* file = nullptr;
  std::size_t channels = 1;
  std::vector<float> frames;

  Handle() = default;
  ~Handle() {
    if (file != nullptr) sf_close(file);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
};

SoundReader::SoundReader(const std::string& path, int rate_Hz) : handle_(std::make_unique<Handle>()) {
  constexpr int kMostChannels = 64;
  SF_INFO info{};
  handle_->file = sf_open(path.c_str(), SFM_READ, &info);
  if (handle_->file == nullptr || info.channels < 1 || info.channels > kMostChannels)
    throw UsageError(path + ": is no sound that can be read, give a WAV or FLAC file");
  if (info.samplerate != rate_Hz)
    throw UsageError(path + ": has " + std::to_string(info.samplerate) + " samples a second, give one with " +
                     std::to_string(rate_Hz));
  handle_->channels = static_cast<std::size_t>(info.channels);
}

SoundReader::~SoundReader() = default;

void SoundReader::read(std::span<float> out) {
  std::vector<float>& frames = handle_->frames;
  frames.assign(out.size() * handle_->channels, 0.0F);
  sf_readf_float(handle_->file, frames.data(), static_cast<sf_count_t>(out.size()));
  for (std::size_t n = 0; n < out.size(); ++n) {
    const float sample = frames[n * handle_->channels];
    out[n] = sample >= -1.0F && sample <= 1.0F ? sample : 0.0F;
  }
}

}  // namespace app
