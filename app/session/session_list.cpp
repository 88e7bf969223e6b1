#include "app/session/session_list.h"

#include <algorithm>
#include <chrono>

#include <fmt/core.h>

#include "app/session/recording_file.h"
#include "app/session/session_folder.h"
#include "app/session/session_reader.h"
#include "calibration/record/utc.h"

namespace app {
namespace {

namespace fs = std::filesystem;

std::int64_t unixSecondsOf(fs::file_time_type time) {
  const auto system = std::chrono::file_clock::to_sys(time);
  return std::chrono::floor<std::chrono::seconds>(system).time_since_epoch().count();
}

void readInto(SessionListing& listing, bool checks) {
  SessionReader session(listing.path);
  const StoredStart about = session.about();
  listing.case_title = about.patient_title;
  if (const auto started = calibration::secondsOfUtc(about.started_utc)) listing.unix_s = *started;
  if (about.setup.former) listing.continues = about.setup.former->file;
  listing.is_imported = about.setup.isImported();
  listing.length_s = session.length_s();
  if (const auto log = session.missingLog()) {
    listing.remark = "its log " + fs::path(*log).filename().string() + " is missing";
    return;
  }
  if (checks)
    if (const auto damage = session.damage()) {
      listing.remark = *damage;
      return;
    }
  listing.verdict = !session.closed()    ? SessionVerdict::killed
                    : session.lost() > 0 ? SessionVerdict::gaps
                                         : SessionVerdict::complete;
  if (listing.verdict == SessionVerdict::killed) listing.remark = "ended early, complete up to then";
  if (listing.verdict == SessionVerdict::gaps) listing.remark = fmt::format("{} ticks lost", session.lost());
}

SessionListing listingOf(const fs::path& path, bool checks) {
  SessionListing listing;
  listing.path = path.string();
  listing.unix_s = unixSecondsOf(lastWritten(path));
  for (const std::string& file : sessionFiles(listing.path)) {
    std::error_code failed;
    if (const auto bytes = fs::file_size(file, failed); !failed) listing.bytes += bytes;
  }
  if (isBeingRecorded(listing.path)) {
    listing.verdict = SessionVerdict::recording;
    listing.remark = "being recorded";
    return listing;
  }
  try {
    readInto(listing, checks);
  } catch (const std::exception& error) {
    listing.verdict = SessionVerdict::damaged;
    listing.remark = error.what();
  }
  return listing;
}

}  // namespace

const char* nameOf(SessionVerdict verdict) {
  constexpr const char* kNames[] = {"complete", "gaps", "killed", "recording", "damaged"};
  return kNames[static_cast<std::size_t>(verdict)];
}

std::vector<SessionListing> listSessions(const fs::path& folder, bool checks, std::size_t at_most) {
  std::vector<std::pair<fs::file_time_type, fs::path>> files;
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator(folder, failed))
    if (entry.path().extension() == ".molar" && entry.is_regular_file(failed))
      files.emplace_back(lastWritten(entry.path()), entry.path());
  std::ranges::sort(files, std::ranges::greater());
  files.resize(std::min(files.size(), at_most));
  std::vector<SessionListing> listings;
  for (const auto& [written, path] : files) listings.push_back(listingOf(path, checks));
  std::ranges::sort(listings, [](const SessionListing& a, const SessionListing& b) {
    return std::pair(a.unix_s, a.path) > std::pair(b.unix_s, b.path);
  });
  return listings;
}

}  // namespace app
