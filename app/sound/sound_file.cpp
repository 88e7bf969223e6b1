#include "app/sound/sound_file.h"

#include <sndfile.h>

#include <utility>

#include "app/text/usage_error.h"
#include "calibration/output_file.h"

namespace app {

struct SoundFile::Handle {
  std::string path;
  SNDFILE* file = nullptr;

  [[noreturn]] void fail() const {
    throw UsageError(calibration::withoutTemporaryNames(path) + ": the sound could not be written (" +
                     sf_strerror(file) + "), check the folder and the space on the disk");
  }
};

SoundFile::SoundFile(const std::string& path, int rate_Hz) : handle_(std::make_unique<Handle>()) {
  SF_INFO info{};
  info.samplerate = rate_Hz;
  info.channels = 1;
  info.format = SF_FORMAT_FLAC | SF_FORMAT_PCM_16;
  handle_->path = path;
  handle_->file = sf_open(path.c_str(), SFM_WRITE, &info);
  if (handle_->file == nullptr) handle_->fail();
}

SoundFile::~SoundFile() {
  if (handle_->file != nullptr) sf_close(handle_->file);
}

void SoundFile::write(std::span<const float> samples) {
  const auto count = static_cast<sf_count_t>(samples.size());
  if (sf_write_float(handle_->file, samples.data(), count) != count) handle_->fail();
}

void SoundFile::close() {
  SNDFILE* const file = std::exchange(handle_->file, nullptr);
  if (file != nullptr && sf_close(file) != 0) handle_->fail();
}

}  // namespace app
