#include "app/evaluation/voice/voice_words.h"

#include <cmath>
#include <cstring>

namespace app {

std::string_view textOf(VoiceTrouble trouble) {
  switch (trouble) {
    case VoiceTrouble::no_microphone:
      return "there is no microphone";
    case VoiceTrouble::disk:
      return "the disk refuses it, make room there";
    case VoiceTrouble::sound:
      return "the file of --microphone cannot be read any more";
  }
  return "";
}

std::optional<VoiceWord> voiceWordFrom(std::span<const std::byte> datagram) {
  if (datagram.size() != sizeof(VoiceWord)) return {};
  VoiceWord word;
  std::memcpy(&word, datagram.data(), sizeof word);
  const bool is_one = word.mark == VoiceWord::kMark && word.kind >= VoiceWord::Kind::began &&
                      word.kind <= VoiceWord::Kind::end && std::isfinite(word.value);
  const bool fits =
      (word.kind != VoiceWord::Kind::trouble || word.number <= static_cast<std::uint64_t>(VoiceTrouble::sound)) &&
      (word.kind != VoiceWord::Kind::figure || word.number < static_cast<std::uint64_t>(VoiceFigure::count));
  return is_one && fits ? std::optional(word) : std::nullopt;
}

}  // namespace app
