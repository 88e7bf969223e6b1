#include "app/evaluation/session_book.h"

#include <filesystem>
#include <system_error>
#include <utility>

#include "app/evaluation/session_tables.h"
#include "app/study/sealed_events.h"
#include "app/text/message.h"
#include "app/text/usage_error.h"
#include "calibration/output_file.h"

namespace app {
namespace {

namespace fs = std::filesystem;

}  // namespace

SessionBook::SessionBook(std::string study_folder, const std::string& participant)
    : study_folder_(std::move(study_folder)) {
  const bool is_there = fs::exists(study_folder_);
  place_ = nextSession(is_there ? sessionsIn(study_folder_) : std::vector<StudySession>(), participant);
}

std::string SessionBook::folder() const { return (fs::path(study_folder_) / place_.folder).string(); }

std::string SessionBook::recording() const { return (fs::path(folder()) / "session.molar").string(); }

void SessionBook::write(std::size_t row) { log_->add(seal_ ? sealedEvent(*seal_, events_[row], row) : events_[row]); }

void SessionBook::keep(const LogEvent& event) {
  events_.push_back(event);
  if (!log_) return;
  write(events_.size() - 1);
  if (const auto trouble = log_->trouble(); trouble && !std::exchange(has_told_trouble_, true)) printMessage(*trouble);
}

bool SessionBook::isSafe(std::size_t events) const { return !log_ || log_->onDisk() >= events; }

void SessionBook::open(const std::string& template_text) {
  std::error_code failed;
  fs::create_directories(study_folder_, failed);
  if (failed || !fs::create_directory(folder(), failed))
    throw UsageError("--out " + study_folder_ + ": " + place_.folder + " cannot be made there, give another folder");
  fs::permissions(folder(), fs::perms::owner_all, failed);
  log_.emplace((fs::path(folder()) / kSessionLogName).string());
  if (const auto keys = publicKeysOf(study_folder_))
    seal_.emplace(*keys, folder(), place_.folder);
  else
    printMessage(study_folder_ + " has no keys: words are kept as they are typed, see molar study keys --help");
  for (std::size_t row = 0; row < events_.size(); ++row) write(row);
  calibration::OutputFile((fs::path(folder()) / "template.toml").string(), false).commit(template_text);
}

void SessionBook::writeTables(const StudyTemplate& study) const {
  for (const SessionTable& table : sessionTables(study, events_, place_.folder)) {
    if (seal_ && table.holdsWords()) continue;
    calibration::OutputFile file((fs::path(folder()) / table.name).string(), true);
    file.commit(table.text);
  }
}

}  // namespace app
