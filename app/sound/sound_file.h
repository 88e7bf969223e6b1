// Samples into a FLAC file, 16 bits, mono, through libsndfile. One thread.
#pragma once

#include <memory>
#include <span>
#include <string>

namespace app {

class SoundFile {
 public:
  /// Writes to exactly `path`, which ends in .flac. Throws UsageError when it cannot be written.
  SoundFile(const std::string& path, int rate_Hz);
  ~SoundFile();
  SoundFile(const SoundFile&) = delete;
  SoundFile& operator=(const SoundFile&) = delete;

  /// -1..1. Throws UsageError, also from close(), when the disk is full.
  void write(std::span<const float> samples);
  void close();

 private:
  struct Handle;
  std::unique_ptr<Handle> handle_;
};

}  // namespace app
