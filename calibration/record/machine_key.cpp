#include "calibration/record/machine_key.h"

#include <fcntl.h>
#include <openssl/evp.h>
#include <openssl/rand.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

namespace calibration {
namespace {

constexpr std::size_t kSeed_bytes = 32, kPublic_bytes = 32, kSignature_bytes = 64;
using Seed = std::array<std::uint8_t, kSeed_bytes>;

template <auto Free>
struct Freed {
  template <class Held>
  void operator()(Held* held) const {
    Free(held);
  }
};
using Key = std::unique_ptr<EVP_PKEY, Freed<EVP_PKEY_free>>;
using Context = std::unique_ptr<EVP_MD_CTX, Freed<EVP_MD_CTX_free>>;

const unsigned char* bytesOf(std::string_view text) { return reinterpret_cast<const unsigned char*>(text.data()); }

std::string hexOf(std::span<const std::uint8_t> bytes) {
  std::string hex;
  for (const std::uint8_t byte : bytes)
    for (const int nibble : {byte >> 4, byte & 15}) hex += "0123456789abcdef"[nibble];
  return hex;
}

/// Empty: not so many bytes in hexadecimal digits.
std::vector<std::uint8_t> bytesOfHex(std::string_view hex, std::size_t count) {
  if (hex.size() != 2 * count) return {};
  std::vector<std::uint8_t> bytes(count);
  for (std::size_t n = 0; n < hex.size(); ++n) {
    const std::size_t digit = std::string_view("0123456789abcdef").find(hex[n]);
    if (digit == std::string_view::npos) return {};
    bytes[n / 2] = static_cast<std::uint8_t>(bytes[n / 2] << 4 | static_cast<unsigned>(digit));
  }
  return bytes;
}

std::filesystem::path keyFile() {
  const char* config = std::getenv("XDG_CONFIG_HOME");
  if (config != nullptr && *config != '\0') return std::filesystem::path(config) / "molar" / "machine.key";
  const char* home = std::getenv("HOME");
  return home == nullptr ? std::filesystem::path() : std::filesystem::path(home) / ".config" / "molar" / "machine.key";
}

/// None: there is none, or others can read it.
std::optional<Seed> savedSeed(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
  if (file < 0) return std::nullopt;
  struct stat facts {};
  Seed seed{};
  constexpr mode_t kOthers = 0077;
  const bool is_good = ::fstat(file, &facts) == 0 && (facts.st_mode & kOthers) == 0 && facts.st_uid == ::geteuid() &&
                       facts.st_size == static_cast<off_t>(seed.size()) &&
                       ::read(file, seed.data(), seed.size()) == static_cast<ssize_t>(seed.size());
  ::close(file);
  return is_good ? std::optional(seed) : std::nullopt;
}

std::optional<Seed> madeSeed(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::create_directories(path.parent_path(), error);
  Seed seed{};
  if (RAND_bytes(seed.data(), static_cast<int>(seed.size())) != 1) return std::nullopt;
  // Whole under another name first; where two programs make one at once, the first stays.
  const std::string unfinished = path.string() + "." + std::to_string(::getpid());
  constexpr mode_t kOwnerAlone = 0600;
  const int file = ::open(unfinished.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kOwnerAlone);
  if (file < 0) return std::nullopt;
  const bool is_written = ::write(file, seed.data(), seed.size()) == static_cast<ssize_t>(seed.size());
  ::close(file);
  const bool is_placed = is_written && ::link(unfinished.c_str(), path.c_str()) == 0;
  ::unlink(unfinished.c_str());
  return is_placed ? std::optional(seed) : savedSeed(path);
}

Key keyOf(const Seed& seed) {
  return Key(EVP_PKEY_new_raw_private_key(EVP_PKEY_ED25519, nullptr, seed.data(), seed.size()));
}

std::string publicKeyOf(const EVP_PKEY* key) {
  std::array<std::uint8_t, kPublic_bytes> bytes{};
  std::size_t size = bytes.size();
  return EVP_PKEY_get_raw_public_key(key, bytes.data(), &size) == 1 ? hexOf(bytes) : std::string();
}

}  // namespace

std::optional<TextSignature> signedByMachine(std::string_view text) {
  const std::filesystem::path path = keyFile();
  if (path.empty()) return std::nullopt;
  std::error_code error;
  std::optional<Seed> seed = savedSeed(path);
  if (!seed && !std::filesystem::exists(path, error)) seed = madeSeed(path);
  if (!seed) return std::nullopt;
  const Key key = keyOf(*seed);
  const Context context(EVP_MD_CTX_new());
  std::array<std::uint8_t, kSignature_bytes> signature{};
  std::size_t size = signature.size();
  if (!key || !context || EVP_DigestSignInit(context.get(), nullptr, nullptr, nullptr, key.get()) != 1 ||
      EVP_DigestSign(context.get(), signature.data(), &size, bytesOf(text), text.size()) != 1)
    return std::nullopt;
  return TextSignature{publicKeyOf(key.get()), hexOf(signature)};
}

bool isSignatureOf(std::string_view text, const TextSignature& signature) {
  const auto public_key = bytesOfHex(signature.public_key, kPublic_bytes);
  const auto bytes = bytesOfHex(signature.signature, kSignature_bytes);
  if (public_key.empty() || bytes.empty()) return false;
  const Key key(EVP_PKEY_new_raw_public_key(EVP_PKEY_ED25519, nullptr, public_key.data(), public_key.size()));
  const Context context(EVP_MD_CTX_new());
  return key && context && EVP_DigestVerifyInit(context.get(), nullptr, nullptr, nullptr, key.get()) == 1 &&
         EVP_DigestVerify(context.get(), bytes.data(), bytes.size(), bytesOf(text), text.size()) == 1;
}

bool isOfThisMachine(const TextSignature& signature) {
  const std::optional<Seed> seed = savedSeed(keyFile());
  const Key key = seed ? keyOf(*seed) : Key();
  return key && publicKeyOf(key.get()) == signature.public_key;
}

}  // namespace calibration
