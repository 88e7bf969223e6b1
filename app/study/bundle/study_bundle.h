// A study, or one session of it, as one ZIP file to hand on: report.html, all numbers, each session's recording, log,
// template and tables. Of a sealed study words and answers are in it only where the owner's key opens them; sealed keys
// never are, so that what stays closed can still be withdrawn. Same study, same bytes. Main thread; as fast as the
// disk.
#pragma once

#include <string>
#include <vector>

#include "app/study/privacy/study_keys.h"

namespace app {

struct WrittenBundle {
  std::vector<std::string> sessions, remarks;
};

/// Whole or not at all, read back and checked before it gets its name. `session` empty: all that were closed. Throws
/// LoadError, UsageError, CalibrationError.
WrittenBundle writeBundle(const std::string& study, const std::string& session, const PrivateStudyKeys* owner,
                          const std::string& file, bool overwrite);

}  // namespace app
