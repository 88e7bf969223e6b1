// The folder of a study as `molar evaluate` fills it: a folder for each session, P07-1 or, begun anew, P07-1-2, with
// its event log and its tables (tasks.csv, problems.csv, answers-vhu-7.csv), which people may edit. Of a session that
// was interrupted and begun anew the later one counts. Start-up; milliseconds a session.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "app/study/privacy/study_keys.h"
#include "app/study/study_data.h"
#include "app/study/study_result.h"

namespace app {

struct StudySession {
  std::string folder;       ///< its name
  std::string participant;  ///< P07
  int visit = 1, attempt = 1;
  bool is_closed = false;  ///< false: it goes on, or was interrupted
};

/// In order of participant, visit and attempt; other folders are passed over. Throws LoadError: there is no such
/// folder.
std::vector<StudySession> sessionsIn(const std::string& study);

/// The last attempt of each visit.
std::vector<StudySession> thoseThatCount(const std::vector<StudySession>& sessions);

/// Name of the next session of a participant: the visit is one more than those that were closed.
StudySession nextSession(const std::vector<StudySession>& sessions, const std::string& participant);

/// How the remark on other questionnaires begins.
inline constexpr char kAlsoAnswered[] = "answered as well, see --questionnaire: ";

struct StudyFolder {
  StudyInput input;
  std::vector<std::string> remarks;  ///< one line each: interrupted, changed, other questionnaires
};

/// `questionnaire`: whose answers are read; empty: the first with scores that was answered. `owner`: opens the words
/// and answers of sealed sessions; null: they stay closed. Throws LoadError with file, line and column; UsageError
/// where nobody answered it.
StudyFolder readStudyFolder(const std::string& study, const std::string& questionnaire,
                            const PrivateStudyKeys* owner = nullptr, const std::vector<std::string>& only = {});

/// A session's tables by name ("problems.csv"): as they stand in its folder; of a sealed one those that are not there
/// as its log tells, for its owner. Adds a remark where something stays closed.
std::map<std::string, CsvTable> tablesOf(const std::string& study, const StudySession& session,
                                         const PrivateStudyKeys* owner, std::vector<std::string>& remarks);

}  // namespace app
