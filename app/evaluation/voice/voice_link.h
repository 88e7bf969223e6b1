// The session's end of `molar voice`: starts the process, takes its words, starts another where it has died, which goes
// on in the same folder, and ends it. Nothing that it does reaches the servo; a read a call, but where the ticks are
// the clock: then it waits until all that is to be heard has been. Main thread. Linux.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/evaluation/voice/voice_process.h"
#include "app/evaluation/voice/voice_words.h"
#include "app/study/privacy/sealing.h"

namespace app {

using VoiceFigures = std::array<std::optional<double>, static_cast<std::size_t>(VoiceFigure::count)>;

class VoiceLink {
 public:
  static constexpr int kMostStarts = 5;

  /// `options` without its descriptors of words and key. `secret`: what is stored is sealed with it, borrowed; null: it
  /// is not. `program`: that is started as `PROGRAM voice …`.
  explicit VoiceLink(VoiceOptions options, const SecretKey* secret = nullptr, std::string program = "/proc/self/exe");
  /// Kills it; all but the newest two seconds is stored.
  ~VoiceLink();
  VoiceLink(const VoiceLink&) = delete;
  VoiceLink& operator=(const VoiceLink&) = delete;

  void start();
  /// What it said since the last call.
  std::vector<VoiceWord> update(std::int64_t now_ns);
  /// Ends it in order, and waits for that. `said`: its last words.
  VoiceFigures finish(std::vector<VoiceWord>& said);
  /// At once: milliseconds later nothing of it is there.
  void kill();

  /// It will say nothing any more.
  bool isOver() const { return is_over_; }
  int starts() const { return starts_; }
  int process() const { return process_; }

 private:
  using Clock = std::chrono::steady_clock;
  void receive(std::vector<VoiceWord>& said);
  void tell(const VoiceWord& word);
  bool hasDied();
  void watch();
  int keyDescriptor() const;

  VoiceOptions options_;
  const SecretKey* secret_;
  std::string program_;
  int words_ = -1, process_ = 0, starts_ = 0;
  bool is_over_ = true;
  std::int64_t through_ns_ = 0;
  Clock::time_point heard_{};
};

}  // namespace app
