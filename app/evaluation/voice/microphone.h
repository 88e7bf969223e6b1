// Where voice comes from: the machine's default input through PortAudio, or a file that stands for one, for tests and
// machines without a card. The input's own thread puts pieces into a ring and does nothing else. Asked from one thread.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/evaluation/voice/heard_block.h"

namespace app {

struct MicrophoneChoice {
  std::string file;          ///< empty: the default input
  bool is_none = false;      ///< nothing is heard
  bool is_realtime = false;  ///< of a file: at the pace of the steady clock, also where the ticks are the clock
};
/// default, none, file:F.wav or file:F.wav,realtime. Throws UsageError: it is none of these, or no sound of 48 kHz.
MicrophoneChoice microphoneFrom(const std::string& text);

class Microphone {
 public:
  virtual ~Microphone() = default;
  /// What has been heard until now, which is never before the call before.
  virtual void takeInto(std::vector<HeardBlock>& heard, std::int64_t now_ns) = 0;
};

/// Searches for up to a second. Null: there is none, `report` was told why.
std::unique_ptr<Microphone> openMicrophone(const std::function<void(const std::string&)>& report);
/// Begins with the first call of takeInto, piece by piece in time; silence behind its end. Throws UsageError.
std::unique_ptr<Microphone> fileMicrophone(const std::string& file);

}  // namespace app
