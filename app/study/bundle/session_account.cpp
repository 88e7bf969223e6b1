#include "app/study/bundle/session_account.h"

#include <filesystem>

#include "app/session/eyes_event.h"
#include "app/session/session_calibration.h"
#include "app/session/session_conditions.h"
#include "app/session/session_error.h"
#include "app/session/session_reader.h"
#include "assets/toml_reader.h"

namespace app {
namespace {

namespace fs = std::filesystem;

void readTemplate(const std::string& path, SessionAccount& account) {
  std::error_code failed;
  if (!fs::exists(path, failed)) return;
  assets::TomlReader keys = assets::TomlReader::fromFile(path);
  account.goal = keys.text("", "title", "");
  account.case_name = keys.text("", "case", "");
  constexpr std::size_t kMostTasks = 1000;
  constexpr double kLongest_s = 1e6;
  const std::size_t count = keys.has("task.1") ? keys.tables("task", 0, kMostTasks) : 0;
  for (std::size_t n = 1; n <= count; ++n) {
    const std::string table = "task." + std::to_string(n);
    account.tasks.push_back({keys.text(table, "id", ""), keys.text(table, "say", ""), keys.text(table, "success", ""),
                             keys.text(table, "fail", ""),
                             keys.number(table, "time_box_s", {0.0, kLongest_s, "s"}, 0.0)});
  }
}

void readRecording(const std::string& path, SessionAccount& account) {
  try {
    SessionReader reader(path);
    const StoredStart start = reader.about();
    account.program = "molar " + start.program_version + ", servo revision " + std::to_string(start.servo.revision) +
                      (start.servo.instruction_set.empty() ? "" : ", " + start.servo.instruction_set);
    account.calibration = start.calibration ? calibrationText(*start.calibration) : "not recorded";
    SessionConditions conditions;
    for (const SessionCommand& one : reader.commands()) conditions.follow(one.command);
    for (const SessionEvent& event : reader.events()) {
      if (event.kind == kServoEvent) conditions.missed_ticks = missedTicksFrom(event.text);
      if (event.kind == kEyesEvent)
        if (const auto eyes = eyesFrom(event.text)) conditions.stereo = eyes->in_stereo;
    }
    account.conditions = conditionsInWords(conditions);
  } catch (const SessionError&) {
    // Its message would name the place of the file.
    account.program = "the recording is not there, or cannot be read";
  }
}

}  // namespace

SessionAccount accountOf(const std::string& study, const StudySession& session, const std::vector<LogEvent>& events) {
  SessionAccount account;
  account.session = session;
  for (const LogEvent& event : events) {
    if (event.type == "session.start")
      account.group = event.textOr("group"), account.evaluator = event.textOr("evaluator");
    if (event.type == "consent") account.consent[event.textOr("stream")] = event.flag("given").value_or(false);
    if (event.type == "verified") {
      account.is_verified = event.flag("recording").value_or(false);
      account.rules_hold = event.number("rules_deviate").value_or(1.0) == 0.0;
    }
  }
  const fs::path folder = fs::path(study) / session.folder;
  readTemplate((folder / "template.toml").string(), account);
  readRecording((folder / "session.molar").string(), account);
  return account;
}

}  // namespace app
