#include "app/study/bundle/study_bundle.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>

#include "app/study/bundle/bundle_check.h"
#include "app/study/bundle/cif_report.h"
#include "app/study/sealed_events.h"
#include "app/study/study_export.h"
#include "app/text/usage_error.h"
#include "assets/load_error.h"
#include "assets/toml_reader.h"
#include "calibration/output_file.h"

namespace app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostText = 64U << 20U;

std::string csvText(const CsvTable& table) {
  std::string text = csvLine(table.heads);
  for (const CsvRow& row : table.rows) text += csvLine(row.cells);
  return text;
}

/// Notes, prompts, bookmarks and help, in the order of the log.
std::string notesTable(const std::vector<LogEvent>& events) {
  constexpr double kSecond = 1e9;
  std::string text = csvLine({"time_s", "tick", "type", "kind", "severity", "task", "words"});
  for (const LogEvent& event : events) {
    if (event.type != "note" && event.type != "prompt" && event.type != "bookmark" && event.type != "help") continue;
    std::string words = event.textOr("text") + event.textOr("label") + event.textOr("reason") + event.textOr("prompt");
    const auto severity = event.number("severity");
    text += csvLine({assets::exactText(static_cast<double>(event.t_ns - events.front().t_ns) / kSecond),
                     event.tick ? std::to_string(*event.tick) : "", event.type, event.textOr("kind"),
                     severity ? assets::exactText(*severity) : "", event.textOr("task"), words});
  }
  return text;
}

class BundleMaker {
 public:
  BundleMaker(const std::string& study, const PrivateStudyKeys* owner, const MoreOfSession& more)
      : study_(study), owner_(owner), more_(more) {}

  void add(const StudySession& session) {
    const std::string at = "sessions/" + session.folder + "/";
    const fs::path folder = fs::path(study_) / session.folder;
    const std::string log = (folder / kSessionLogName).string();
    const SessionLog read = readSessionLog(log);
    entries_.push_back({at + kSessionLogName, assets::readSmallFile(log, kMostText), ""});
    entries_.push_back({at + "template.toml", assets::readSmallFile((folder / "template.toml").string()), ""});
    if (const fs::path recording = folder / "session.molar"; fs::exists(recording))
      entries_.push_back({at + "session.molar", "", recording.string()});
    std::optional<OpenedSession> opened;
    if (owner_ != nullptr) opened.emplace(*owner_, folder.string(), session.folder);
    const OpenedEvents said = openedEvents(read.events, opened ? &*opened : nullptr, log);
    entries_.push_back({at + "notes.csv", notesTable(said.events), ""});
    std::vector<std::string> told;  // by the study's reader
    for (const auto& [name, table] : tablesOf(study_, session, owner_, told)) {
      entries_.push_back({at + name, csvText(table), ""});
      if (name.starts_with("answers-")) answered_.insert(name.substr(8, name.size() - 8 - 4));
    }
    if (more_)
      for (ZipEntry& entry : more_(session, said.events, report_.remarks)) {
        entry.name = at + entry.name;
        entries_.push_back(std::move(entry));
      }
    report_.sessions.push_back(accountOf(study_, session, said.events));
    sessions_.push_back(session.folder);
  }

  void finish() {
    std::vector<std::string> ids{answered_.begin(), answered_.end()};
    const std::vector<std::string> shipped = shippedQuestionnaires();
    const std::size_t all = ids.size();
    std::erase_if(ids, [&](const std::string& id) { return std::ranges::find(shipped, id) == shipped.end(); });
    if (ids.size() < all)
      report_.remarks.emplace_back("Answers to a site's own questionnaire are in its sessions' tables alone.");
    if (ids.empty()) ids.emplace_back();
    for (const std::string& id : ids) {
      StudyFolder folder = readStudyFolder(study_, id, owner_, sessions_);
      if (report_.results.empty())
        std::ranges::copy_if(folder.remarks, std::back_inserter(report_.remarks),
                             [](const std::string& one) { return !one.starts_with(kAlsoAnswered); });
      else
        folder.input.tasks.clear(), folder.input.problems.clear();
      const StudyResult result = studyResult(folder.input);
      const std::string name = "study" + (id.empty() ? "" : "-" + id);
      entries_.push_back({name + ".csv", studyCsv(result), ""});
      entries_.push_back({name + ".json", studyJson(result), ""});
      report_.results.push_back(result);
    }
    entries_.push_back({"report.html", cifPage(report_), ""});
  }

  std::vector<ZipEntry> entries() const { return withManifest(entries_, sessions_, owner_); }
  const std::vector<std::string>& sessions() const { return sessions_; }
  const std::vector<std::string>& remarks() const { return report_.remarks; }

 private:
  const std::string& study_;
  const PrivateStudyKeys* owner_;
  const MoreOfSession& more_;
  std::vector<ZipEntry> entries_;
  CifReport report_;
  std::set<std::string> answered_;
  std::vector<std::string> sessions_;
};

}  // namespace

WrittenBundle writeBundle(const std::string& study, const std::string& session, const PrivateStudyKeys* owner,
                          const std::string& file, bool overwrite, const MoreOfSession& more) {
  calibration::OutputFile out(file, overwrite);
  BundleMaker maker(study, owner, more);
  WrittenBundle written;
  for (const StudySession& one : thoseThatCount(sessionsIn(study))) {
    if (!session.empty() && one.folder != session) continue;
    const std::string log = (fs::path(study) / one.folder / kSessionLogName).string();
    if (const auto damage = readSessionLog(log).damage)
      throw assets::LoadError(*damage + ": it is not handed on, see --session for the others");
    if (one.is_closed)
      maker.add(one);
    else
      written.remarks.push_back(one.folder + ": interrupted, or goes on: left out");
  }
  if (maker.sessions().empty())
    throw UsageError("study export: " + (session.empty()
                                             ? study + " holds no session that was closed"
                                             : session + " is no session of " + study + " that was closed"));
  maker.finish();
  const std::vector<ZipEntry> entries = maker.entries();
  writeZip(out.temporaryPath(), entries);
  if (const BundleCheck check = checkBundle(out.temporaryPath()); !check.wrong.empty())
    throw UsageError("study export: " + check.wrong.front() + " while it was read: nothing is written, try again");
  out.commit();
  written.sessions = maker.sessions();
  written.remarks.insert(written.remarks.end(), maker.remarks().begin(), maker.remarks().end());
  return written;
}

}  // namespace app
