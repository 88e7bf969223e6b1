// `molar compare A B` and `molar trend [FOLDER]`: recorded rehearsals beside each other and over time.

#include <cstdio>
#include <memory>
#include <optional>

#include "app/commands/command.h"
#include "app/review/session_comparison.h"
#include "app/review/session_trend.h"
#include "app/session/session_folder.h"
#include "app/text/command_line.h"
#include "app/text/message.h"

namespace app {

void addCompare(CommandLine& molar) {
  struct Options {
    std::string a, b;
    bool json = false;
  };
  auto options = std::make_shared<Options>();
  CommandLine& command =
      molar.command("compare", "Two rehearsals of one case: measures, steps, bone that only one took");
  command.option("FIRST", options->a, kSessionHelp).required();
  command.option("SECOND", options->b, kSessionHelp).required();
  command.flag("--json", options->json, "All of it as JSON");
  command.footer("As a page with pictures: molar report SECOND --compare FIRST --out FILE.html");
  command.does([options] {
    const SessionComparison found = comparisonOf(sessionNamed(options->a), sessionNamed(options->b));
    std::fputs((options->json ? comparisonJson(found) : comparisonText(found)).c_str(), stdout);
    return 0;
  });
}

void addTrend(CommandLine& molar) {
  struct Options {
    std::string folder, reference;
    bool json = false;
  };
  auto options = std::make_shared<Options>();
  CommandLine& command = molar.command("trend", "The rehearsals of a folder over time, by case: median and range");
  command.option("FOLDER", options->folder, "Of recorded sessions (default: the data folder)");
  command.option("--reference", options->reference, kReferenceHelp).valueNamed("SET");
  command.flag("--json", options->json, "All of it as JSON");
  command.does([options] {
    std::optional<ReferenceSet> set;
    if (!options->reference.empty()) set = loadReference(options->reference);
    const std::filesystem::path folder =
        options->folder.empty() ? usualSessionFolder() : std::filesystem::path(options->folder);
    const std::vector<CaseTrend> cases = trendOf(folder, printMessage);
    const ReferenceSet* const against = set ? &*set : nullptr;
    std::fputs((options->json ? trendJson(cases, against) : trendText(cases, against)).c_str(), stdout);
    return 0;
  });
}

}  // namespace app
