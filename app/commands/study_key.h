// The study's private key on a command line: --key FILE, and where its passphrase comes from. Main thread; a second for
// the passphrase.
#pragma once

#include <optional>
#include <string>

#include "app/study/privacy/study_keys.h"
#include "app/text/command_line.h"

namespace app {

struct StudyKeyOption {
  std::string key, passphrase_file;

  void addTo(CommandLine& command, const std::string& what_for);
  /// None: no --key was given. Throws UsageError, LoadError.
  std::optional<PrivateStudyKeys> opened() const;
  /// The same, and it must be that of the study, where the study has keys.
  std::optional<PrivateStudyKeys> openedFor(const std::string& study) const;
};

}  // namespace app
