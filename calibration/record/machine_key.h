// Texts signed with a key that this machine keeps for itself (Ed25519, RFC 8032, by OpenSSL): proves that a text is as
// this machine wrote it, not who sat there. The key is molar/machine.key in XDG_CONFIG_HOME or ~/.config, for its owner
// alone; it is made at the first signature. Any thread; under a millisecond.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace calibration {

/// Hexadecimal digits.
struct TextSignature {
  std::string public_key, signature;
};

/// None: no key can be kept here.
std::optional<TextSignature> signedByMachine(std::string_view text);

bool isSignatureOf(std::string_view text, const TextSignature& signature);
/// The key is this machine's; false also where it has none.
bool isOfThisMachine(const TextSignature& signature);

}  // namespace calibration
