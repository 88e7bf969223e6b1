// The tables of one session, made from its event log, in the form that `molar study` reads: tasks.csv, problems.csv,
// answers-ID.csv of each questionnaire that was answered. Pure; any thread; milliseconds.
#pragma once

#include <string>
#include <vector>

#include "app/study/questionnaire.h"
#include "app/study/session_log.h"

namespace app {

struct SessionTable {
  std::string name, text;  ///< "tasks.csv"

  /// What somebody said or answered stands in it: of a session that is sealed it is not written.
  bool holdsWords() const { return name != "tasks.csv"; }
};

/// `folder` names the session in links to moments: "P07-1 3:41". `asked`: their items are the columns, in this order.
std::vector<SessionTable> logTables(const std::vector<const Questionnaire*>& asked, const std::vector<LogEvent>& events,
                                    const std::string& folder);
/// The same where the template is not at hand: of questionnaires that are not shipped the items that were answered.
std::vector<SessionTable> logTables(const std::vector<LogEvent>& events, const std::string& folder);

}  // namespace app
