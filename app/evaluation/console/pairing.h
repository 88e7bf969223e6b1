// Who may see a page that is shared on a network: whoever types the six digits that stand on the operator's terminal,
// in five tries; then a token, for twelve hours. The session's process decides, so that another page process changes
// nothing. Also its certificate, made for this session (console/certificate). One thread.
#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "app/evaluation/console/page_words.h"

namespace app {

/// 32 hexadecimal digits from the kernel.
std::string randomWord();

class Pairing {
 public:
  static constexpr int kTries = 5;
  static constexpr std::chrono::hours kValid{12};

  /// Not shared: everybody on this machine may, and nothing is made. Throws SessionError: no certificate can be made.
  explicit Pairing(bool is_shared);
  ~Pairing();
  Pairing(const Pairing&) = delete;
  Pairing& operator=(const Pairing&) = delete;

  const std::string& digits() const { return digits_; }
  /// Of the certificate, as a browser shows it.
  const std::string& fingerprint() const { return fingerprint_; }
  /// A line down: {"kind":"paired","request":…,"token":…} or "why".
  std::string answerTo(const PagePairs& asked);
  /// The tokens that are valid, for each page process; empty where it is not shared.
  std::string greeting() const;
  /// For the page's process: where certificate and key are.
  std::vector<std::string> options() const;
  std::vector<int> descriptors() const;

 private:
  using Time = std::chrono::steady_clock::time_point;
  bool is_shared_;
  std::string digits_, fingerprint_;
  int tries_ = 0, identity_ = -1;
  std::vector<std::pair<std::string, Time>> tokens_;  ///< until
};

}  // namespace app
