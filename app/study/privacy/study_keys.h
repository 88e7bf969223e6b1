// The keys of a study. STUDY/study_keys.json holds the public halves: X25519, to which every session's keys are sealed,
// and Ed25519, by which a bundle is proved. The private half is one secret of 32 bytes in a file that the owner takes
// away, locked by a passphrase (Argon2id, 256 MiB, 3 passes: half a second a guess). Any thread; microseconds but for
// the passphrase. Bad files: LoadError; what cannot be written: CalibrationError.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "app/study/privacy/sealing.h"

namespace app {

inline constexpr char kStudyKeysName[] = "study_keys.json";

struct PublicStudyKeys {
  std::array<std::uint8_t, 32> seal{}, sign{};

  /// 16 hexadecimal digits, to be told apart by people.
  std::string fingerprint() const;
  bool operator==(const PublicStudyKeys&) const = default;
};

class PrivateStudyKeys {
 public:
  /// The pairs follow from the secret alone.
  explicit PrivateStudyKeys(const SecretKey& secret);

  const PublicStudyKeys& publicKeys() const { return public_; }
  /// What was sealed to the study; none: to another one, or changed.
  std::optional<SecretKey> opened(std::string_view sealed) const;
  /// 64 bytes.
  std::string signatureOf(std::string_view text) const;

 private:
  PublicStudyKeys public_;
  SecretKey seal_, sign_;  ///< of Ed25519 the seed
};

/// A session's key, sealed so that the study's private key alone opens it: 80 bytes.
std::string sealedTo(const PublicStudyKeys& study, const SecretKey& key);
bool isSignedBy(const PublicStudyKeys& study, std::string_view text, std::string_view signature);

/// What one guess of the passphrase costs.
struct PassphraseCost {
  std::uint64_t passes = 3, bytes = std::uint64_t{256} << 20U;
};
/// Of fewer bytes than that a passphrase is refused.
inline constexpr std::size_t kShortestPassphrase = 12;

/// Makes the folder where there is none. Throws UsageError: the study has keys, or the key file lies within it.
PublicStudyKeys createStudyKeys(const std::string& study, const std::string& key_file, std::string_view passphrase,
                                const PassphraseCost& cost = {});
/// None: the study has no keys. Throws LoadError.
std::optional<PublicStudyKeys> publicKeysOf(const std::string& study);
/// The public halves as they stand in the file, and read from it.
std::string textOf(const PublicStudyKeys& keys);
PublicStudyKeys publicKeysFrom(std::string_view text, const std::string& where);

/// Throws LoadError: no such file, or another passphrase.
PrivateStudyKeys openStudyKeys(const std::string& key_file, std::string_view passphrase);

}  // namespace app
