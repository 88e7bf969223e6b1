#include "app/study/withdrawal.h"

#include <sys/stat.h>

#include <algorithm>
#include <filesystem>

#include "app/study/audit.h"
#include "app/study/privacy/session_seal.h"
#include "app/study/sealed_events.h"
#include "app/study/session_log.h"
#include "app/study/study_folder.h"
#include "app/text/list.h"
#include "app/text/usage_error.h"
#include "assets/load_error.h"
#include "assets/toml_reader.h"
#include "calibration/calibration_error.h"
#include "calibration/output_file.h"
#include "calibration/record/utc.h"

namespace app {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kSecondsInDay = 86'400;
constexpr std::int64_t kUsualDays = 365, kMostDays = 36'500;

bool isPicture(const std::string& name) {
  return name.ends_with(".png") || name.ends_with(".jpg") || name.ends_with(".jpeg") || name == "pictures";
}

/// A file or folder beside the recording belongs to this stream.
bool belongsTo(std::string_view stream, const std::string& name) {
  if (stream == "all")
    return belongsTo("audio", name) || belongsTo("words", name) || belongsTo("answers", name) ||
           belongsTo("picture", name);
  if (stream == "audio") return name == "voice" || name == "audio" || name.starts_with("audio.");
  if (stream == "words") return name == "problems.csv" || name.ends_with(".bookmarks.json");
  if (stream == "answers") return name.starts_with("answers-") && name.ends_with(".csv");
  return isPicture(name);
}

bool takes(std::string_view stream, std::string_view one) { return stream == one || stream == "all"; }

bool isTakenBack(const LogEvent& event, std::string_view stream, std::string_view key) {
  return isSaid(event, key) && takes(stream, event.type == "answer" ? "answers" : "words");
}

std::vector<LogEvent> withoutWords(std::vector<LogEvent> events, std::string_view stream) {
  for (LogEvent& event : events)
    std::erase_if(event.data, [&](const auto& datum) { return isTakenBack(event, stream, datum.first); });
  return events;
}

bool holdsOpenWords(const std::vector<LogEvent>& events, std::string_view stream) {
  return std::ranges::any_of(events, [&](const LogEvent& event) {
    return std::ranges::any_of(event.data, [&](const auto& datum) { return isTakenBack(event, stream, datum.first); });
  });
}

void removeOrThrow(const fs::path& path) {
  std::error_code failed;
  fs::remove_all(path, failed);
  if (failed)
    throw calibration::CalibrationError(path.string() + ": cannot be removed (" + failed.message() +
                                        "), remove it by hand");
}

/// Beside the old one, then in its place.
std::string writeAnew(const fs::path& log, const std::vector<LogEvent>& events) {
  const fs::path anew = log.string() + ".new";
  removeOrThrow(anew);
  {
    SessionLogWriter writer(anew.string());
    for (const LogEvent& event : events) writer.add(event);
    if (const auto trouble = writer.trouble()) throw calibration::CalibrationError(*trouble);
  }
  fs::rename(anew, log);
  calibration::syncToDisk(log.parent_path().string());
  return readSessionLog(log.string()).digest;
}

struct Stopped {
  std::int64_t at_s = 0, days = kUsualDays;
};

/// What the log says; else when it was written last, and the template's days.
Stopped stopOf(const fs::path& folder) {
  Stopped stopped;
  const fs::path path = folder / kSessionLogName;
  for (const LogEvent& event : readSessionLog(path.string()).events) {
    if (const auto at = calibration::secondsOfUtc(event.textOr("utc"))) stopped.at_s = std::max(stopped.at_s, *at);
    if (const auto days = event.number("retention_days"); days && *days >= 0.0 && *days <= kMostDays) {
      stopped.days = static_cast<std::int64_t>(*days);
      if (stopped.at_s > 0) return stopped;
    }
  }
  struct stat written {};
  if (stopped.at_s == 0 && ::stat(path.c_str(), &written) == 0) stopped.at_s = written.st_mtime;
  return stopped;
}

}  // namespace

std::vector<Removal> withdrawalOf(const std::string& study, const std::string& participant, std::string_view stream) {
  std::vector<Removal> removals;
  bool is_known = false;
  for (const StudySession& session : sessionsIn(study)) {
    if (session.participant != participant) continue;
    is_known = true;
    const fs::path folder = fs::path(study) / session.folder;
    Removal removal{session.folder, {}, false};
    for (std::size_t n = 0; n < kSealedStreams.size(); ++n)
      if (takes(stream, kSealedStreams[n]) && fs::exists(sealedKeyPath(folder.string(), static_cast<SealedStream>(n))))
        removal.files.push_back("keys/" + std::string(kSealedStreams[n]) + ".key");
    std::vector<std::string> beside;
    for (const auto& entry : fs::directory_iterator(folder)) {
      const std::string name = entry.path().filename().string();
      if (belongsTo(stream, name)) beside.push_back(name + (entry.is_directory() ? "/" : ""));
    }
    std::ranges::sort(beside);
    removal.files.insert(removal.files.end(), beside.begin(), beside.end());
    removal.rewrites_log = holdsOpenWords(readSessionLog((folder / kSessionLogName).string()).events, stream);
    if (!removal.isNothing()) removals.push_back(std::move(removal));
  }
  if (!is_known) throw UsageError("study withdraw: " + participant + " is in no session of " + study);
  return removals;
}

void withdraw(const std::string& study, const std::string& participant, std::string_view stream,
              const std::vector<Removal>& removals, std::int64_t now_s) {
  // First what will be done: a kill in between leaves a row, and the same command does the rest.
  audit(study, now_s, "withdraw",
        {{"participant", participant},
         {"stream", std::string(stream)},
         {"sessions", joined(removals, &Removal::session)}});
  for (const Removal& removal : removals) {
    const fs::path folder = fs::path(study) / removal.session;
    for (const std::string& file : removal.files) removeOrThrow(folder / file);
    calibration::syncToDisk(folder.string());
    if (!removal.rewrites_log) continue;
    const fs::path path = folder / kSessionLogName;
    const SessionLog before = readSessionLog(path.string());
    const std::string digest = writeAnew(path, withoutWords(before.events, stream));
    audit(study, now_s, "log.rewritten",
          {{"session", removal.session}, {"digest_before", before.digest}, {"digest_after", digest}});
  }
}

std::vector<Expired> expiredSessions(const std::string& study, std::int64_t now_s) {
  if (const auto newest = newestAudit_s(study); newest && *newest > now_s)
    throw UsageError("study retain: it is " + calibration::utcOf(now_s) + ", but " + study + "/" + kAuditName +
                     " tells of " + calibration::utcOf(*newest) + ": set the clock, nothing is removed");
  std::vector<Expired> expired;
  for (const StudySession& session : sessionsIn(study)) {
    const Stopped stopped = stopOf(fs::path(study) / session.folder);
    if (stopped.at_s + stopped.days * kSecondsInDay <= now_s)
      expired.push_back({session.folder, calibration::utcOf(stopped.at_s), stopped.days});
  }
  return expired;
}

void removeExpired(const std::string& study, const std::vector<Expired>& expired, std::int64_t now_s) {
  for (const Expired& one : expired) {
    audit(study, now_s, "retain",
          {{"session", one.session}, {"stopped_utc", one.stopped_utc}, {"retention_days", one.days}});
    const fs::path folder = fs::path(study) / one.session;
    removeOrThrow(folder / "keys");
    removeOrThrow(folder);
  }
  calibration::syncToDisk(study);
}

}  // namespace app
