// What is handed to the sound card, in shared memory, for another process that wants to know what is echo: the newest
// 1.4 s with the time at which they were handed over. Writer: the card's thread, no lock, no allocation. Readers: any
// process that has the descriptor; they trust nothing in it. Times: steady clock, ns.
#pragma once

#include <cstdint>
#include <span>

namespace app {

class PlayedSound {
 public:
  /// Throws UsageError: there is no memory.
  PlayedSound();
  ~PlayedSound();
  PlayedSound(const PlayedSound&) = delete;
  PlayedSound& operator=(const PlayedSound&) = delete;

  /// Of the memory, closed in programs that are started.
  int descriptor() const { return memory_; }
  void add(std::span<const float> samples, double rate_Hz, std::int64_t now_ns) noexcept;

  struct Shared;

 private:
  int memory_;
  Shared* shared_;
};

class PlayedSoundReader {
 public:
  /// Borrows the descriptor; none (-1), or one that is no such memory: silence.
  PlayedSoundReader(int descriptor, double rate_Hz);
  ~PlayedSoundReader();
  PlayedSoundReader(const PlayedSoundReader&) = delete;
  PlayedSoundReader& operator=(const PlayedSoundReader&) = delete;

  bool isThere() const { return shared_ != nullptr; }
  /// Samples at the reader's rate that were handed over from then on: calls one after another, each as long as the time
  /// from the one before. Silence where nothing was, or is not known any more.
  void read(std::int64_t from_ns, std::span<float> out);

 private:
  const PlayedSound::Shared* shared_ = nullptr;
  double rate_Hz_, position_ = -1.0;  ///< of the next sample, in the writer's
};

}  // namespace app
