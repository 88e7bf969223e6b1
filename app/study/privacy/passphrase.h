// A passphrase, asked for at the terminal without being shown, or the first line of a file or descriptor (/dev/fd/3);
// never of the command line, where others see it. Wiped when it goes. Main thread; as long as the person types.
#pragma once

#include <string>
#include <string_view>

namespace app {

class Passphrase {
 public:
  explicit Passphrase(std::string words) : words_(std::move(words)) {}
  ~Passphrase();
  Passphrase(const Passphrase&) = delete;
  Passphrase& operator=(const Passphrase&) = delete;

  std::string_view words() const { return words_; }

 private:
  std::string words_;
};

/// `file` empty: at the terminal; `twice`: a new one, typed again. Throws UsageError: no terminal, two that differ, no
/// such file, or an empty one.
Passphrase passphraseFrom(const std::string& file, bool twice);

}  // namespace app
