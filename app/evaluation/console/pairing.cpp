#include "app/evaluation/console/pairing.h"

#include <sys/mman.h>
#include <sys/random.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "app/evaluation/console/certificate.h"
#include "app/session/session_error.h"

namespace app {
namespace {

using PairingJson = nlohmann::json;

template <std::size_t kBytes>
std::array<std::uint8_t, kBytes> randomBytes() {
  std::array<std::uint8_t, kBytes> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) std::abort();
  return bytes;
}

/// In a time that does not tell where they differ.
bool areAlike(const std::string& left, const std::string& right) {
  if (left.size() != right.size()) return false;
  unsigned differ = 0;
  for (std::size_t n = 0; n < left.size(); ++n)
    differ |= static_cast<unsigned>(static_cast<unsigned char>(left[n]) ^ static_cast<unsigned char>(right[n]));
  return differ == 0;
}

std::string sixDigits() {
  constexpr std::uint32_t kCodes = 1'000'000, kFair = UINT32_MAX - UINT32_MAX % kCodes;
  for (;;) {
    std::uint32_t number = 0;
    for (const std::uint8_t byte : randomBytes<4>()) number = number << 8U | byte;
    if (number < kFair) return fmt::format("{:06}", number % kCodes);
  }
}

}  // namespace

std::string randomWord() {
  std::string word;
  for (const std::uint8_t byte : randomBytes<16>()) word += fmt::format("{:02x}", byte);
  return word;
}

Pairing::Pairing(bool is_shared) : is_shared_(is_shared) {
  if (!is_shared_) return;
  digits_ = sixDigits();
  const std::string identity = selfMadeIdentity();
  fingerprint_ = fingerprintOf(identity);
  identity_ = ::memfd_create("molar page identity", MFD_CLOEXEC);
  if (identity_ < 0 || ::write(identity_, identity.data(), identity.size()) != static_cast<ssize_t>(identity.size()))
    throw SessionError("--share: there is no memory for a certificate, close other programs");
}

Pairing::~Pairing() {
  if (identity_ >= 0) ::close(identity_);
}

std::string Pairing::answerTo(const PagePairs& asked) {
  PairingJson answer{{"kind", "paired"}, {"request", asked.request}};
  constexpr std::size_t kMostTokens = 64;
  if (!is_shared_ || tries_ >= kTries || tokens_.size() >= kMostTokens) {
    answer["why"] = "no more tries: begin the session again for another code";
  } else if (!areAlike(asked.digits, digits_)) {
    ++tries_;
    answer["why"] = fmt::format("not that code, {} tries are left", kTries - tries_);
  } else {
    tokens_.emplace_back(randomWord() + randomWord(), std::chrono::steady_clock::now() + kValid);
    answer["token"] = tokens_.back().first;
  }
  return answer.dump(-1, ' ', false, PairingJson::error_handler_t::replace);
}

std::string Pairing::greeting() const {
  if (!is_shared_) return "";
  PairingJson all = PairingJson::array();
  for (const auto& [token, until] : tokens_)
    all.push_back({{"token", token}, {"until_ns", until.time_since_epoch().count()}});
  return PairingJson{{"kind", "tokens"}, {"tokens", all}}.dump();
}

std::vector<std::string> Pairing::options() const {
  if (!is_shared_) return {};
  return {"--identity", std::to_string(identity_)};
}

std::vector<int> Pairing::descriptors() const { return is_shared_ ? std::vector<int>{identity_} : std::vector<int>{}; }

}  // namespace app
