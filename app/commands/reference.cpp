// `molar reference NAME SESSION…`: recorded rehearsals of one case as a named set that others are held against.

#include <cstdio>
#include <filesystem>
#include <memory>

#include <fmt/core.h>

#include "app/commands/command.h"
#include "app/review/reference_set.h"
#include "app/session/data_folder.h"
#include "app/session/session_folder.h"
#include "app/station/session_case.h"
#include "app/text/command_line.h"
#include "app/text/message.h"
#include "app/text/usage_error.h"
#include "calibration/output_file.h"

namespace app {
namespace {

struct ReferenceOptions {
  std::string name, out;
  std::vector<std::string> sessions;
  bool force = false;
};

int listReferences() {
  for (const std::string& name : referenceNames()) {
    try {
      const ReferenceSet set = loadReference(name);
      std::printf("%-24s %zu runs of %s, made %s\n", name.c_str(), set.runs.size(), set.case_title.c_str(),
                  set.made_utc.c_str());
    } catch (const UsageError& error) {
      printMessage(error.what());
    }
  }
  return 0;
}

int makeReference(const ReferenceOptions& options) {
  const std::string file = options.out.empty() ? referenceFile(options.name) : options.out;
  if (!file.ends_with(".json")) throw UsageError("--out " + file + ": name it .json");
  referenceFile(options.name);  // the name is checked in any case
  if (options.out.empty()) makeDataFolder(std::filesystem::path(file).parent_path());
  calibration::OutputFile out(file, options.force);
  std::vector<SessionMetrics> runs;
  for (const std::string& session : options.sessions) runs.push_back(metricsOf(sessionNamed(session), caseOfSession));
  const ReferenceSet set = referenceOf(options.name, runs);
  for (std::size_t n = 0; n < runs.size(); ++n)
    if (runs[n].removed_mm3 <= 0.0)
      printMessage(fmt::format("run {} removed nothing: is it meant to be a reference?", n + 1));
  out.commit(referenceText(set));
  std::printf("%s: %zu runs of %s%s\n", set.name.c_str(), set.runs.size(), set.case_title.c_str(),
              set.runs.size() < kLeastRuns ? ", from 3 on it gives z-scores" : "");
  return 0;
}

}  // namespace

void addReference(CommandLine& molar) {
  auto options = std::make_shared<ReferenceOptions>();
  CommandLine& command =
      molar.command("reference", "Rehearsals of one case as a named set that others are held against");
  command.option("NAME", options->name, "Of the set: letters, digits, - and _; without it the sets are listed");
  command.option("SESSION", options->sessions, "Recorded sessions of one case, three or more for z-scores");
  command.option("--out", options->out, "File to write, .json [one of the name in the data folder]").valueNamed("FILE");
  command.flag("--force", options->force, "Replace a set of that name");
  command.footer(
      "It holds measures alone, no path and no name of a person. Then: molar metrics SESSION --reference NAME, molar "
      "report SESSION --reference NAME --out FILE.html, molar trend --reference NAME");
  command.does([options] {
    if (options->name.empty()) return listReferences();
    if (options->sessions.empty())
      throw UsageError("reference " + options->name + ": of which runs, name recorded sessions behind it");
    return makeReference(*options);
  });
}

}  // namespace app
