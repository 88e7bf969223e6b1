// What `molar voice` and its rehearsal say to each other: words of one size, one in a datagram. Nothing of it is
// trusted. Plain values; one thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace app {

struct VoiceWord {
  enum class Kind : std::uint32_t {
    // From the process.
    began = 1,  ///< it records
    trouble,    ///< and does not record any more, or at all; `number`: a VoiceTrouble
    level,      ///< 10 times a second: `value` in dB of full scale, `number` ms of speech in the green so far
    speech,     ///< from then on; `number` 1: somebody speaks
    through,    ///< all that was to be heard until then has been looked at
    figure,     ///< `number`: a VoiceFigure, `value` its
    ended,      ///< all is stored
    // To the process.
    clock,  ///< it is that time, where the ticks are the clock
    end,    ///< it is to end in order
  };
  static constexpr std::uint32_t kMark = 0x6369'6f76;

  std::uint32_t mark = kMark;
  Kind kind = Kind::level;
  std::int64_t t_ns = 0;
  std::uint64_t number = 0;
  double value = 0.0;
};
static_assert(sizeof(VoiceWord) == 32);

enum class VoiceTrouble : std::uint64_t { no_microphone, disk, sound };
/// One line.
std::string_view textOf(VoiceTrouble trouble);

enum class VoiceFigure : std::uint64_t {
  seconds,
  segments,
  gaps,
  drift_ppm,
  speech_s,
  delay_start_ms,
  delay_end_ms,
  processor_s,
  count
};

/// None: it is no such datagram.
std::optional<VoiceWord> voiceWordFrom(std::span<const std::byte> datagram);

}  // namespace app
