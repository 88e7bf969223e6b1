#include "app/study/privacy/study_keys.h"

#include <fcntl.h>
#include <sodium.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "app/text/usage_error.h"
#include "assets/json_depth.h"
#include "assets/load_error.h"
#include "assets/toml_reader.h"
#include "calibration/output_file.h"
#include "calibration/record/sha256.h"

namespace app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::size_t kMostKeyBytes = 4096, kSaltBytes = crypto_pwhash_SALTBYTES;
constexpr char kPublicKind[] = "molar study keys", kPrivateKind[] = "molar study private key";
constexpr char kContext[crypto_kdf_CONTEXTBYTES + 1] = "molarstu";
constexpr std::uint64_t kMostPasses = 20, kMostBytes = std::uint64_t{1} << 30U;

const unsigned char* unsignedOf(std::string_view text) { return reinterpret_cast<const unsigned char*>(text.data()); }

/// The keys of a small JSON file that somebody may have changed.
class KeyFile {
 public:
  KeyFile(std::string_view text, std::string where, const char* kind) : where_(std::move(where)) {
    if (!assets::isNestedTooDeep(text)) json_ = json::parse(text.begin(), text.end(), nullptr, false);
    if (!json_.is_object() || this->text("kind") != kind || number("version", 1, 1) != 1)
      refuse("it is no file of " + std::string(kind) + ", see molar study keys");
  }
  std::string text(const char* key) const {
    if (!json_.contains(key) || !json_[key].is_string()) refuse("\"" + std::string(key) + "\" is missing");
    return json_[key].get<std::string>();
  }
  std::string bytes(const char* key, std::size_t count) const {
    const auto bytes = fromBase64(text(key));
    if (!bytes || bytes->size() != count) refuse("\"" + std::string(key) + "\" was changed");
    return *bytes;
  }
  std::uint64_t number(const char* key, std::uint64_t low, std::uint64_t high) const {
    if (!json_.contains(key) || !json_[key].is_number_unsigned()) refuse("\"" + std::string(key) + "\" is missing");
    const auto value = json_[key].get<std::uint64_t>();
    if (value < low || value > high) refuse("\"" + std::string(key) + "\" is out of range");
    return value;
  }
  [[noreturn]] void refuse(const std::string& reason) const { throw assets::LoadError(where_ + ": " + reason); }

 private:
  std::string where_;
  json json_;
};

/// Argon2id of the passphrase.
SecretKey lockOf(std::string_view passphrase, std::string_view salt, const PassphraseCost& cost) {
  SecretKey key;
  if (crypto_pwhash(key.data(), SecretKey::kBytes, passphrase.data(), passphrase.size(), unsignedOf(salt), cost.passes,
                    cost.bytes, crypto_pwhash_ALG_ARGON2ID13) != 0)
    throw UsageError("the passphrase needs " + std::to_string(cost.bytes >> 20U) + " MB of memory, close something");
  return key;
}

/// For its owner alone, and never over another file.
void writeKeyFile(const std::string& path, const std::string& text) {
  constexpr mode_t kOwnerReads = 0400;
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kOwnerReads);
  const int error = file < 0 ? errno : 0;
  const bool is_whole =
      file >= 0 && ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size()) && ::fsync(file) == 0;
  if (file >= 0) ::close(file);
  if (is_whole) return;
  if (file >= 0) ::unlink(path.c_str());
  throw UsageError("--key " + path + ": it cannot be written (" + std::strerror(error == 0 ? ENOSPC : error) +
                   "), name a new file");
}

bool liesWithin(const std::string& file, const std::string& folder) {
  std::error_code failed;
  const fs::path inner = fs::weakly_canonical(fs::absolute(file), failed),
                 outer = fs::weakly_canonical(fs::absolute(folder), failed);
  const auto [at, end] = std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end());
  (void)end;
  return at == outer.end() || (at->empty() && std::next(at) == outer.end());
}

}  // namespace

std::string textOf(const PublicStudyKeys& keys) {
  return ordered_json{{"kind", kPublicKind},
                      {"version", 1},
                      {"seal_x25519", base64Of(keys.seal)},
                      {"sign_ed25519", base64Of(keys.sign)}}
             .dump(2) +
         "\n";
}

std::string PublicStudyKeys::fingerprint() const {
  constexpr std::size_t kDigits = 16;
  return calibration::sha256Of(textOf(*this)).substr(0, kDigits);
}

PrivateStudyKeys::PrivateStudyKeys(const SecretKey& secret) {
  SecretKey seed;
  constexpr std::uint64_t kSeal = 1, kSign = 2;
  crypto_kdf_derive_from_key(seed.data(), SecretKey::kBytes, kSeal, kContext, secret.data());
  crypto_box_seed_keypair(public_.seal.data(), seal_.data(), seed.data());
  crypto_kdf_derive_from_key(sign_.data(), SecretKey::kBytes, kSign, kContext, secret.data());
  std::array<unsigned char, crypto_sign_SECRETKEYBYTES> pair;
  crypto_sign_seed_keypair(public_.sign.data(), pair.data(), sign_.data());
  sodium_memzero(pair.data(), pair.size());
}

std::optional<SecretKey> PrivateStudyKeys::opened(std::string_view sealed) const {
  SecretKey key;
  if (sealed.size() != SecretKey::kBytes + crypto_box_SEALBYTES ||
      crypto_box_seal_open(key.data(), unsignedOf(sealed), sealed.size(), public_.seal.data(), seal_.data()) != 0)
    return {};
  return key;
}

std::string PrivateStudyKeys::signatureOf(std::string_view text) const {
  std::array<unsigned char, crypto_sign_SECRETKEYBYTES> pair;
  std::array<unsigned char, crypto_sign_PUBLICKEYBYTES> half;
  crypto_sign_seed_keypair(half.data(), pair.data(), sign_.data());
  std::string signature(crypto_sign_BYTES, '\0');
  crypto_sign_detached(reinterpret_cast<unsigned char*>(signature.data()), nullptr, unsignedOf(text), text.size(),
                       pair.data());
  sodium_memzero(pair.data(), pair.size());
  return signature;
}

std::string sealedTo(const PublicStudyKeys& study, const SecretKey& key) {
  startSealing();
  std::string sealed(SecretKey::kBytes + crypto_box_SEALBYTES, '\0');
  crypto_box_seal(reinterpret_cast<unsigned char*>(sealed.data()), key.data(), SecretKey::kBytes, study.seal.data());
  return sealed;
}

bool isSignedBy(const PublicStudyKeys& study, std::string_view text, std::string_view signature) {
  startSealing();
  return signature.size() == crypto_sign_BYTES &&
         crypto_sign_verify_detached(unsignedOf(signature), unsignedOf(text), text.size(), study.sign.data()) == 0;
}

PublicStudyKeys createStudyKeys(const std::string& study, const std::string& key_file, std::string_view passphrase,
                                const PassphraseCost& cost) {
  if (passphrase.size() < kShortestPassphrase)
    throw UsageError("the passphrase has fewer than " + std::to_string(kShortestPassphrase) +
                     " letters, give some words");
  if (publicKeysOf(study)) throw UsageError(study + ": this study has keys, they stay as long as it does");
  if (liesWithin(key_file, study))
    throw UsageError("--key " + key_file + ": it would lie in the study, name a place that you take away");
  const SecretKey secret = SecretKey::random();
  const PublicStudyKeys keys = PrivateStudyKeys(secret).publicKeys();
  std::string salt(kSaltBytes, '\0');
  randombytes_buf(salt.data(), salt.size());
  const std::string known = textOf(keys);
  const SecretKey lock = lockOf(passphrase, salt, cost);
  const std::string locked = sealedWith(lock, {keys.fingerprint(), kPrivateKind, 1},
                                        {reinterpret_cast<const char*>(secret.data()), SecretKey::kBytes});
  std::error_code failed;
  fs::create_directories(study, failed);
  calibration::OutputFile open_half((fs::path(study) / kStudyKeysName).string(), false);
  // Private first: public keys without it would seal what nobody opens.
  writeKeyFile(key_file, ordered_json{{"kind", kPrivateKind},
                                      {"version", 1},
                                      {"study", keys.fingerprint()},
                                      {"argon2id_passes", cost.passes},
                                      {"argon2id_bytes", cost.bytes},
                                      {"salt", base64Of(salt)},
                                      {"locked", base64Of(locked)}}
                                 .dump(2) +
                             "\n");
  open_half.commit(known);
  return keys;
}

PublicStudyKeys publicKeysFrom(std::string_view text, const std::string& where) {
  startSealing();
  const KeyFile file(text, where, kPublicKind);
  PublicStudyKeys keys;
  std::ranges::copy(file.bytes("seal_x25519", keys.seal.size()), keys.seal.begin());
  std::ranges::copy(file.bytes("sign_ed25519", keys.sign.size()), keys.sign.begin());
  return keys;
}

std::optional<PublicStudyKeys> publicKeysOf(const std::string& study) {
  const std::string path = (fs::path(study) / kStudyKeysName).string();
  std::error_code failed;
  if (!fs::exists(fs::symlink_status(path, failed))) return {};
  return publicKeysFrom(assets::readSmallFile(path, kMostKeyBytes), path);
}

PrivateStudyKeys openStudyKeys(const std::string& key_file, std::string_view passphrase) {
  startSealing();
  const KeyFile file(assets::readSmallFile(key_file, kMostKeyBytes), key_file, kPrivateKind);
  // What a file asks for is bounded: it may be somebody else's.
  const PassphraseCost cost{file.number("argon2id_passes", 1, kMostPasses),
                            file.number("argon2id_bytes", crypto_pwhash_MEMLIMIT_MIN, kMostBytes)};
  const SecretKey lock = lockOf(passphrase, file.bytes("salt", kSaltBytes), cost);
  const auto locked = fromBase64(file.text("locked"));
  auto plain = locked ? openedWith(lock, {file.text("study"), kPrivateKind, 1}, *locked) : std::nullopt;
  if (!plain || plain->size() != SecretKey::kBytes) file.refuse("it does not open with this passphrase");
  SecretKey secret;
  std::memcpy(secret.data(), plain->data(), SecretKey::kBytes);
  sodium_memzero(plain->data(), plain->size());
  return PrivateStudyKeys(secret);
}

}  // namespace app
