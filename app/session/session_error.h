// The exception of this folder: a session that cannot be written, or a file that is not a readable session. The text is
// one line: what, where, what to do.
#pragma once

#include <stdexcept>
#include <string>

namespace app {

enum class SessionErrorKind {
  refused,  ///< the name or the file is not usable
  damaged,  ///< the stored bytes are not those recorded
  failed,   ///< disk, permissions or memory: the state of the file is unknown
};

struct SessionError : std::runtime_error {
  explicit SessionError(const std::string& line, SessionErrorKind which = SessionErrorKind::refused)
      : std::runtime_error(line), kind(which) {}
  SessionErrorKind kind;
};

/// "WHAT: the session is damaged". Control characters quoted from the file are replaced, so the text stays one line.
inline SessionError damagedSession(std::string what) {
  for (char& c : what)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '?';
  return SessionError(what + ": the session is damaged", SessionErrorKind::damaged);
}

}  // namespace app
