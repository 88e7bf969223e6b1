// `molar sessions`: the recorded rehearsals of the data folder.

#include <cstdio>
#include <memory>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "app/commands/command.h"
#include "app/session/session_folder.h"
#include "app/session/session_list.h"
#include "app/text/clock_text.h"
#include "app/text/command_line.h"
#include "app/text/usage_error.h"
#include "calibration/record/utc.h"

namespace app {
namespace {

struct SessionsOptions {
  std::string folder;
  bool json = false, checks = false;
};

std::string json(const std::vector<SessionListing>& sessions) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const SessionListing& one : sessions) {
    list.push_back({{"file", one.path},
                    {"started_utc", calibration::utcOf(one.unix_s)},
                    {"case", one.case_title},
                    {"length_s", one.length_s},
                    {"bytes", one.bytes},
                    {"verdict", nameOf(one.verdict)},
                    {"remark", one.remark},
                    {"continues", nullptr}});
    if (one.continues) list.back()["continues"] = *one.continues;
  }
  return list.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

/// One session a line, and the folder below.
std::string table(const std::vector<SessionListing>& sessions, const std::filesystem::path& folder) {
  std::string text;
  double total_MB = 0.0;
  for (const SessionListing& one : sessions) {
    total_MB += 1e-6 * static_cast<double>(one.bytes);
    text += fmt::format("{}  {:>6}  {:9}  {}\n{:18}{}\n", localDateTime(one.unix_s), clockText(one.length_s),
                        nameOf(one.verdict), one.case_title.empty() ? one.remark : one.case_title, "",
                        std::filesystem::path(one.path).filename().string() +
                            (one.continues ? ", continues " + *one.continues : "") +
                            (one.case_title.empty() || one.remark.empty() ? "" : ", " + one.remark));
  }
  return text + fmt::format("{} session{}, {:.0f} MB in {}; times are local\n", sessions.size(),
                            sessions.size() == 1 ? "" : "s", total_MB, folder.string());
}

int list(const SessionsOptions& options) {
  const std::filesystem::path folder =
      options.folder.empty() ? usualSessionFolder() : std::filesystem::path(options.folder);
  if (!options.folder.empty() && !std::filesystem::is_directory(folder))
    throw UsageError("--folder " + options.folder + ": no such folder, check the name");
  const std::vector<SessionListing> sessions = listSessions(folder, options.checks);
  std::fputs((options.json ? json(sessions) : table(sessions, folder)).c_str(), stdout);
  return 0;
}

}  // namespace

void addSessions(CommandLine& molar) {
  auto options = std::make_shared<SessionsOptions>();
  CommandLine& command = molar.command("sessions", "Recorded rehearsals, newest first: date, length, state, case");
  command.option("--folder", options->folder, "Folder to list [the data folder]").valueNamed("DIR");
  command.flag("--check", options->checks, "Read every byte and find any changed one; slow");
  command.flag("--json", options->json, "JSON");
  command.does([options] { return list(*options); });
}

}  // namespace app
