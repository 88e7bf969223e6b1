#include "app/study/privacy/sealing.h"

#include <sodium.h>

#include <new>
#include <vector>

#include "app/text/usage_error.h"

namespace app {
namespace {

constexpr std::size_t kNonceBytes = crypto_aead_xchacha20poly1305_ietf_NPUBBYTES,
                      kTagBytes = crypto_aead_xchacha20poly1305_ietf_ABYTES, kStep = 64;
static_assert(SecretKey::kBytes == crypto_aead_xchacha20poly1305_ietf_KEYBYTES);

const unsigned char* bytesOf(std::string_view text) { return reinterpret_cast<const unsigned char*>(text.data()); }
unsigned char* bytesOf(std::string& text) { return reinterpret_cast<unsigned char*>(text.data()); }

/// Lengths first, so that no two places read alike.
std::string authenticated(const SealPlace& place) {
  std::string text = "molar 1";
  const auto add = [&](std::uint64_t number) {
    for (unsigned shift = 0; shift < 64; shift += 8) text += static_cast<char>((number >> shift) & 0xFFU);
  };
  for (const std::string_view part : {place.session, place.table}) add(part.size()), text += part;
  add(place.row);
  return text;
}

}  // namespace

void startSealing() {
  if (sodium_init() < 0)
    throw UsageError("libsodium does not start: no randomness on this machine, see its kernel log");
}

void SecretKey::Wipe::operator()(std::uint8_t* bytes) const { sodium_free(bytes); }

SecretKey::SecretKey() {
  startSealing();
  bytes_.reset(static_cast<std::uint8_t*>(sodium_malloc(kBytes)));
  if (!bytes_) throw std::bad_alloc();
  sodium_memzero(bytes_.get(), kBytes);
}

SecretKey SecretKey::random() {
  SecretKey key;
  randombytes_buf(key.data(), kBytes);
  return key;
}

std::string sealedWith(const SecretKey& key, const SealPlace& place, std::string_view plain) {
  std::string padded(plain);
  padded.resize((plain.size() / kStep + 1) * kStep);
  std::size_t length = 0;
  sodium_pad(&length, bytesOf(padded), plain.size(), kStep, padded.size());
  std::string sealed(kNonceBytes + padded.size() + kTagBytes, '\0');
  randombytes_buf(sealed.data(), kNonceBytes);
  const std::string bound = authenticated(place);
  crypto_aead_xchacha20poly1305_ietf_encrypt(bytesOf(sealed) + kNonceBytes, nullptr, bytesOf(padded), padded.size(),
                                             bytesOf(bound), bound.size(), nullptr, bytesOf(sealed), key.data());
  sodium_memzero(padded.data(), padded.size());
  return sealed;
}

std::optional<std::string> openedWith(const SecretKey& key, const SealPlace& place, std::string_view sealed) {
  if (sealed.size() < kNonceBytes + kTagBytes + kStep) return {};
  std::string plain(sealed.size() - kNonceBytes - kTagBytes, '\0');
  const std::string bound = authenticated(place);
  if (crypto_aead_xchacha20poly1305_ietf_decrypt(bytesOf(plain), nullptr, nullptr, bytesOf(sealed) + kNonceBytes,
                                                 sealed.size() - kNonceBytes, bytesOf(bound), bound.size(),
                                                 bytesOf(sealed), key.data()) != 0)
    return {};
  std::size_t length = 0;
  if (sodium_unpad(&length, bytesOf(plain), plain.size(), kStep) != 0) return {};
  plain.resize(length);
  return plain;
}

std::string base64Of(std::span<const std::uint8_t> bytes) {
  std::string text(sodium_base64_ENCODED_LEN(bytes.size(), sodium_base64_VARIANT_ORIGINAL), '\0');
  sodium_bin2base64(text.data(), text.size(), bytes.data(), bytes.size(), sodium_base64_VARIANT_ORIGINAL);
  text.pop_back();  // its end of a C string
  return text;
}

std::string base64Of(std::string_view bytes) {
  return base64Of(std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()));
}

std::optional<std::string> fromBase64(std::string_view text) {
  std::string bytes(text.size() / 4 * 3 + 3, '\0');
  std::size_t length = 0;
  const char* end = nullptr;
  if (sodium_base642bin(bytesOf(bytes), bytes.size(), text.data(), text.size(), nullptr, &length, &end,
                        sodium_base64_VARIANT_ORIGINAL) != 0 ||
      end != text.data() + text.size())
    return {};
  bytes.resize(length);
  // One spelling alone: libsodium takes letters with a high bit for others.
  return base64Of(bytes) == text ? std::optional(bytes) : std::nullopt;
}

}  // namespace app
