// Lines that are typed and shortened letter by letter, in UTF-8. Pure; any thread.
#pragma once

#include <cstdint>
#include <string>

namespace app {

inline void addLetter(std::string& to, char32_t letter) {
  const auto code = static_cast<std::uint32_t>(letter);
  const auto put = [&](std::uint32_t byte) { to += static_cast<char>(byte); };
  if (code < 0x80) {
    put(code);
  } else if (code < 0x800) {
    put(0xc0 | code >> 6), put(0x80 | (code & 0x3f));
  } else if (code < 0x10000) {
    put(0xe0 | code >> 12), put(0x80 | (code >> 6 & 0x3f)), put(0x80 | (code & 0x3f));
  } else {
    put(0xf0 | code >> 18), put(0x80 | (code >> 12 & 0x3f)), put(0x80 | (code >> 6 & 0x3f)), put(0x80 | (code & 0x3f));
  }
}

/// The last one, whole; nothing where there is none.
inline void removeLetter(std::string& from) {
  while (!from.empty() && (static_cast<unsigned char>(from.back()) & 0xc0) == 0x80) from.pop_back();
  if (!from.empty()) from.pop_back();
}

}  // namespace app
