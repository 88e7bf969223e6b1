#include "app/study/study_folder.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
#include <set>
#include <tuple>

#include "app/study/log_tables.h"
#include "app/study/sealed_events.h"
#include "app/study/session_log.h"
#include "app/text/anonymous_id.h"
#include "app/text/list.h"
#include "app/text/usage_error.h"
#include "assets/load_error.h"

namespace app {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kAnswers = "answers-", kTable = ".csv";

std::optional<int> countFrom(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  constexpr int kMost = 9999;
  return error == std::errc() && end == text.data() + text.size() && value > 0 && value <= kMost ? std::optional(value)
                                                                                                 : std::nullopt;
}

/// "P07-1", "P07-1-2", also of a code with a hyphen: "P-07-1".
std::optional<StudySession> sessionNamed(const std::string& folder) {
  StudySession session;
  session.folder = folder;
  std::vector<std::string_view> parts = split(folder, '-');
  std::size_t code = 1;
  if (parts.size() > 2 && !isAnonymousId(std::string(parts[0]))) code = 2;
  if (parts.size() != code + 1 && parts.size() != code + 2) return {};
  session.participant = std::string(parts[0]) + (code == 2 ? "-" + std::string(parts[1]) : "");
  const auto visit = countFrom(parts[code]);
  const auto attempt = parts.size() == code + 2 ? countFrom(parts[code + 1]) : 1;
  if (!isAnonymousId(session.participant) || !visit || !attempt) return {};
  session.visit = *visit, session.attempt = *attempt;
  return session;
}

/// Numbers before words; of shipped questionnaires, as others are known by their files alone.
std::string firstWithScores(const std::vector<std::string>& ids) {
  const std::vector<std::string> shipped = shippedQuestionnaires();
  for (const std::string& id : ids)
    if (std::ranges::find(shipped, id) != shipped.end() && !questionnaireNamed(id).isOfWords()) return id;
  return ids.front();
}

}  // namespace

std::vector<StudySession> sessionsIn(const std::string& study) {
  std::error_code failed;
  std::vector<StudySession> sessions;
  fs::directory_iterator entries(study, failed);
  if (failed) throw assets::LoadError(study + ": is no folder of a study, see molar evaluate --out");
  for (const auto& entry : entries) {
    auto session = sessionNamed(entry.path().filename().string());
    const fs::path log = entry.path() / kSessionLogName;
    if (!session || !fs::is_regular_file(log, failed)) continue;
    session->is_closed = readSessionLog(log.string()).is_closed;
    sessions.push_back(std::move(*session));
  }
  std::ranges::sort(sessions, {},
                    [](const StudySession& one) { return std::tuple(one.participant, one.visit, one.attempt); });
  return sessions;
}

std::vector<StudySession> thoseThatCount(const std::vector<StudySession>& sessions) {
  std::vector<StudySession> last;
  for (const StudySession& session : sessions) {
    if (!last.empty() && last.back().participant == session.participant && last.back().visit == session.visit)
      last.pop_back();
    last.push_back(session);
  }
  return last;
}

StudySession nextSession(const std::vector<StudySession>& sessions, const std::string& participant) {
  StudySession next;
  next.participant = participant;
  for (const StudySession& one : sessions) {
    if (one.participant != participant) continue;
    next.visit = one.is_closed ? one.visit + 1 : one.visit;
    next.attempt = one.is_closed ? 1 : one.attempt + 1;
  }
  next.folder = participant + "-" + std::to_string(next.visit) +
                (next.attempt > 1 ? "-" + std::to_string(next.attempt) : std::string());
  return next;
}

std::map<std::string, CsvTable> tablesOf(const std::string& study, const StudySession& session,
                                         const PrivateStudyKeys* owner, std::vector<std::string>& remarks) {
  std::map<std::string, CsvTable> tables;
  const fs::path place = fs::path(study) / session.folder;
  const std::string log = (place / kSessionLogName).string();
  const std::vector<LogEvent> events = readSessionLog(log).events;
  if (openedEvents(events, nullptr, log).sealed > 0) {
    std::optional<OpenedSession> opened;
    if (owner != nullptr) opened.emplace(*owner, place.string(), session.folder);
    const OpenedEvents said = openedEvents(events, opened ? &*opened : nullptr, log);
    if (said.sealed > 0)
      remarks.push_back(session.folder + ": words and answers of " + std::to_string(said.sealed) + " rows are closed" +
                        (owner == nullptr ? ", give --key FILE" : ": withdrawn, or sealed to another study"));
    if (owner != nullptr)
      for (const SessionTable& table : logTables(said.events, session.folder))
        tables.emplace(table.name, csvTableFrom(table.text, log + ", " + table.name));
  }
  for (const auto& entry : fs::directory_iterator(place)) {
    const std::string name = entry.path().filename().string();
    if (name == "tasks.csv" || name == "problems.csv" || (name.starts_with(kAnswers) && name.ends_with(kTable)))
      tables.insert_or_assign(name, csvTableOf(entry.path().string()));
  }
  return tables;
}

StudyFolder readStudyFolder(const std::string& study, const std::string& questionnaire, const PrivateStudyKeys* owner,
                            const std::vector<std::string>& only) {
  std::vector<StudySession> sessions = sessionsIn(study);
  if (!only.empty())
    std::erase_if(sessions, [&](const StudySession& one) { return std::ranges::find(only, one.folder) == only.end(); });
  if (sessions.empty()) throw assets::LoadError(study + ": holds no session of an evaluation, see molar evaluate");
  StudyFolder folder;
  const std::vector<StudySession> counted = thoseThatCount(sessions);
  for (const StudySession& session : sessions) {
    const bool counts = std::ranges::find(counted, session.folder, &StudySession::folder) != counted.end();
    if (!session.is_closed)
      folder.remarks.push_back(session.folder + " was interrupted, or goes on" +
                               (counts ? ": what it holds so far counts" : "; it was begun anew and does not count"));
    if (const auto damage = readSessionLog((fs::path(study) / session.folder / kSessionLogName).string()).damage)
      folder.remarks.push_back(*damage);
  }
  StudyInput& input = folder.input;
  std::map<std::string, std::vector<CsvTable>> answers;
  std::set<std::string> participants;
  for (const StudySession& session : counted) {
    participants.insert(session.participant);
    for (auto& [name, table] : tablesOf(study, session, owner, folder.remarks)) {
      if (name == "tasks.csv") {
        for (TaskRun& run : tasksFrom(table)) {
          // Sessions are never pooled.
          if (session.visit > 1) run.task += " (session " + std::to_string(session.visit) + ")";
          input.tasks.push_back(std::move(run));
        }
      } else if (name == "problems.csv") {
        for (ProblemSeen& one : problemsFrom(table)) input.problems.push_back(std::move(one));
      } else {
        answers[name.substr(kAnswers.size(), name.size() - kAnswers.size() - kTable.size())].push_back(
            std::move(table));
      }
    }
  }
  input.merged = mergedIn(study);
  input.ratings = ratingsIn(study);
  input.participants = participants.size();
  std::vector<std::string> ids;
  for (const auto& [id, tables] : answers) ids.push_back(id);
  if (questionnaire.empty() && ids.empty()) return folder;
  input.questionnaire = questionnaireNamed(questionnaire.empty() ? firstWithScores(ids) : questionnaire);
  const auto found = answers.find(input.questionnaire->id);
  if (found == answers.end())
    throw UsageError("--questionnaire " + questionnaire + ": nobody has answered it in " + study +
                     (ids.empty() ? std::string() : ", give one of " + joined(ids)));
  for (const CsvTable& table : found->second)
    for (AnswerSheet& sheet : answersFrom(table, *input.questionnaire)) input.answers.push_back(std::move(sheet));
  std::erase(ids, input.questionnaire->id);
  if (!ids.empty()) folder.remarks.push_back(kAlsoAnswered + joined(ids));
  return folder;
}

}  // namespace app
