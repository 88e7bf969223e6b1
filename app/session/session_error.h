// The one exception of sessions: a file that can not be written, or one that is not a readable session.
// The text is one line: what, where, what to do. What is to be concluded of the file stands beside it.
#pragma once

#include <stdexcept>
#include <string>

namespace app {

enum class SessionErrorKind {
  refused,  ///< the name, or what lies there, is not what is needed
  damaged,  ///< what is stored is not what was recorded
  failed,   ///< disk, rights or memory: nothing is known of the file
};

struct SessionError : std::runtime_error {
  explicit SessionError(const std::string& line, SessionErrorKind which = SessionErrorKind::refused)
      : std::runtime_error(line), trouble(which) {}
  SessionErrorKind trouble;
};

/// "…: the session is damaged", as it is said of every stored part that can not be what was recorded. What it quotes of
/// the file stays on the line.
inline SessionError damagedSession(std::string what) {
  for (char& c : what)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '?';
  return SessionError(what + ": the session is damaged", SessionErrorKind::damaged);
}

}  // namespace app
