#include "app/study/privacy/passphrase.h"

#include <fcntl.h>
#include <sodium.h>
#include <termios.h>
#include <unistd.h>

#include <cstdio>

#include "app/text/usage_error.h"

namespace app {
namespace {

constexpr std::size_t kLongest = 1024;

/// Letters are not shown while this lives.
class Unseen {
 public:
  explicit Unseen(int terminal) : terminal_(terminal) {
    tcgetattr(terminal_, &before_);
    termios unseen = before_;
    unseen.c_lflag &= ~static_cast<tcflag_t>(ECHO);
    tcsetattr(terminal_, TCSAFLUSH, &unseen);
  }
  ~Unseen() { tcsetattr(terminal_, TCSAFLUSH, &before_); }
  Unseen(const Unseen&) = delete;
  Unseen& operator=(const Unseen&) = delete;

 private:
  int terminal_;
  termios before_{};
};

/// Up to the end of the line, byte by byte: nothing is left in a buffer.
std::string lineOf(int file) {
  std::string line;
  line.reserve(kLongest);
  for (char letter = 0; line.size() < kLongest && ::read(file, &letter, 1) == 1 && letter != '\n';)
    if (letter != '\r') line += letter;
  return line;
}

std::string asked(int terminal, const char* question) {
  std::fprintf(stderr, "%s ", question);
  std::string line;
  {
    const Unseen unseen(terminal);
    line = lineOf(terminal);
  }
  std::fputc('\n', stderr);
  return line;
}

}  // namespace

Passphrase::~Passphrase() { sodium_memzero(words_.data(), words_.size()); }

Passphrase passphraseFrom(const std::string& file, bool twice) {
  const int source = ::open(file.empty() ? "/dev/tty" : file.c_str(), (file.empty() ? O_RDWR : O_RDONLY) | O_CLOEXEC);
  if (source < 0)
    throw UsageError(file.empty() ? "the passphrase is asked for at a terminal, run it in one or give --passphrase-file"
                                  : "--passphrase-file " + file + ": cannot be read, check the name");
  std::string line = file.empty() ? asked(source, "Passphrase:") : lineOf(source);
  const bool is_same = !twice || !file.empty() || asked(source, "Again:") == line;
  ::close(source);
  if (!is_same) throw UsageError("the two passphrases differ, begin again");
  if (line.empty())
    throw UsageError(file.empty() ? "the passphrase is empty, begin again"
                                  : "--passphrase-file " + file + ": its first line is empty");
  return Passphrase(std::move(line));
}

}  // namespace app
