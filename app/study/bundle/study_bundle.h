// A study, or one session of it, as one ZIP file to hand on: report.html, all numbers, each session's recording, log,
// template and tables. Of a sealed study words and answers are in it only where the owner's key opens them; sealed keys
// never are, so that what stays closed can still be withdrawn. Same study, same bytes. Main thread; as fast as the
// disk.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/study/bundle/zip_file.h"
#include "app/study/privacy/study_keys.h"
#include "app/study/session_log.h"
#include "app/study/study_folder.h"

namespace app {

struct WrittenBundle {
  std::vector<std::string> sessions, remarks;
};

/// More of a session for its folder in the bundle, and remarks on what is left out; `said`: its log, opened where it
/// can be. Empty: none.
using MoreOfSession = std::function<std::vector<ZipEntry>(
    const StudySession& session, const std::vector<LogEvent>& said, std::vector<std::string>& remarks)>;

/// Whole or not at all, read back and checked before it gets its name. `session` empty: all that were closed. Throws
/// LoadError, UsageError, CalibrationError.
WrittenBundle writeBundle(const std::string& study, const std::string& session, const PrivateStudyKeys* owner,
                          const std::string& file, bool overwrite, const MoreOfSession& more = {});

}  // namespace app
