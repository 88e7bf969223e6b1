// A WAV or FLAC file read piece by piece, mono: of several channels the first. One thread.
#pragma once

#include <memory>
#include <span>
#include <string>

namespace app {

class SoundReader {
 public:
  /// Throws UsageError: there is no such file, or it is no sound of this rate.
  SoundReader(const std::string& path, int rate_Hz);
  ~SoundReader();
  SoundReader(const SoundReader&) = delete;
  SoundReader& operator=(const SoundReader&) = delete;

  /// Fills `out`; behind the end of the file with silence.
  void read(std::span<float> out);

 private:
  struct Handle;
  std::unique_ptr<Handle> handle_;
};

}  // namespace app
