#include "app/evaluation/session_tables.h"

namespace app {

std::vector<SessionTable> sessionTables(const StudyTemplate& study, const std::vector<LogEvent>& events,
                                        const std::string& folder) {
  std::vector<const Questionnaire*> asked;
  for (const AskedQuestionnaire& one : study.questionnaires) asked.push_back(&one.questionnaire);
  return logTables(asked, events, folder);
}

}  // namespace app
