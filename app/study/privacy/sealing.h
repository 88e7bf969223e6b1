// Encryption of what people said: XChaCha20-Poly1305 under a key of 32 bytes that lives in locked memory and is wiped
// when it goes (libsodium). What is sealed opens at its own place alone: session, table and row are authenticated with
// it, and its length shows in steps of 64 bytes only. Any thread; 2 µs a sentence.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace app {

/// Moved, never copied.
class SecretKey {
 public:
  static constexpr std::size_t kBytes = 32;

  /// Zeros, to be written into.
  SecretKey();
  static SecretKey random();

  std::uint8_t* data() { return bytes_.get(); }
  const std::uint8_t* data() const { return bytes_.get(); }

 private:
  struct Wipe {
    void operator()(std::uint8_t* bytes) const;
  };
  std::unique_ptr<std::uint8_t[], Wipe> bytes_;
};

/// Where something sealed belongs: "P07-1", "events", the row's number.
struct SealPlace {
  std::string_view session, table;
  std::uint64_t row = 0;
};

/// Nonce, ciphertext and tag, as bytes.
std::string sealedWith(const SecretKey& key, const SealPlace& place, std::string_view plain);
/// None: another key or place, or a changed byte.
std::optional<std::string> openedWith(const SecretKey& key, const SealPlace& place, std::string_view sealed);

std::string base64Of(std::span<const std::uint8_t> bytes);
std::string base64Of(std::string_view bytes);
/// None: it is no base64.
std::optional<std::string> fromBase64(std::string_view text);

/// Once before anything of libsodium. Throws UsageError: it does not start.
void startSealing();

}  // namespace app
