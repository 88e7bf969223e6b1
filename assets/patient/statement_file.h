// deidentified.toml of a patient folder: the statement of what an imported scan kept and dropped
// (scan_origin_toml.h), signed with this machine's key, not reviewed until a person has looked at the pictures and says
// so. Any thread; the digest of the volume takes 1 s per GB.
#pragma once

#include <optional>
#include <string>

namespace assets {

enum class Seal { none, broken, of_another_machine, of_this_machine };

struct StatementFacts {
  bool is_reviewed = false;  ///< a person has looked at the pictures, and it is whole
  Seal seal = Seal::none;
  bool is_of_volume = false;  ///< the volume beside it is the one that it is of
};

/// The text with a new signature after it, in place of any old one; without one where the machine can keep no key.
std::string sealedStatement(std::string text);

/// Neither changed nor without the signature that this machine can make, and of the volume beside it.
bool isWhole(const StatementFacts& facts);

/// The same of a volume after edits, signed anew: nobody has reviewed that one. For a statement that is whole.
std::string statementAfterEdits(std::string text, const std::string& volume_sha256);

/// None: the folder has no statement. Throws LoadError: it cannot be read.
std::optional<StatementFacts> statementIn(const std::string& folder);

/// A person has looked at all pictures: they name nobody. Throws LoadError: the folder has no statement, or one that
/// was changed, is of another volume or has no signature though this machine can sign; CalibrationError: it cannot be
/// written.
void reviewStatement(const std::string& folder);

/// SHA-256 of a file; hexadecimal digits.
std::string digestOfFile(const std::string& path);

}  // namespace assets
