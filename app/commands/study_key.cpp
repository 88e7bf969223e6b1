#include "app/commands/study_key.h"

#include "app/study/privacy/passphrase.h"
#include "app/text/usage_error.h"

namespace app {

void StudyKeyOption::addTo(CommandLine& command, const std::string& what_for) {
  command.option("--key", key, what_for).valueNamed("FILE");
  command
      .option("--passphrase-file", passphrase_file,
              "Its passphrase: first line of a file, or of a descriptor as /dev/fd/3 [asked for at the terminal]")
      .valueNamed("FILE");
}

std::optional<PrivateStudyKeys> StudyKeyOption::opened() const {
  if (key.empty()) {
    if (!passphrase_file.empty()) throw UsageError("--passphrase-file " + passphrase_file + ": of which --key?");
    return {};
  }
  return openStudyKeys(key, passphraseFrom(passphrase_file, false).words());
}

std::optional<PrivateStudyKeys> StudyKeyOption::openedFor(const std::string& study) const {
  auto owner = opened();
  if (!owner) return {};
  const auto known = publicKeysOf(study);
  if (!known) throw UsageError("--key " + key + ": " + study + " has no keys, leave it out");
  if (*known != owner->publicKeys()) throw UsageError("--key " + key + ": it is the key of another study");
  return owner;
}

}  // namespace app
