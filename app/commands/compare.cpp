// `molar compare A B` and `molar trend [FOLDER]`: recorded rehearsals beside each other and over time.

#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

#include "app/commands/command.h"
#include "app/review/comparison_page.h"
#include "app/review/session_comparison.h"
#include "app/review/session_trend.h"
#include "app/session/session_folder.h"
#include "app/text/command_line.h"
#include "app/text/message.h"
#include "app/text/usage_error.h"
#include "calibration/output_file.h"

namespace app {

void addCompare(CommandLine& molar) {
  struct Options {
    std::string a, b, out;
    bool json = false, force = false;
  };
  auto options = std::make_shared<Options>();
  CommandLine& command =
      molar.command("compare", "Two rehearsals of one case: measures, steps, bone that only one took");
  command.option("FIRST", options->a, kSessionHelp).required();
  command.option("SECOND", options->b, kSessionHelp).required();
  command.flag("--json", options->json, "All of it as JSON");
  command.option("--out", options->out, "As a page with pictures of both results, .html; it needs no other file")
      .valueNamed("FILE");
  command.flag("--force", options->force, "Replace the output if it exists");
  command.does([options] {
    const std::string a = sessionNamed(options->a), b = sessionNamed(options->b);
    std::optional<calibration::OutputFile> out;
    if (!options->out.empty()) {
      if (options->json) throw UsageError("--json, --out: give one of them");
      if (!options->out.ends_with(".html"))
        throw UsageError("--out " + options->out + ": a comparison is a page, name it .html");
      out.emplace(options->out, options->force);
    }
    const ComparedEnds ends = comparedEnds(a, b);
    for (const auto& [path, left] : {std::pair(&a, &ends.left_a), std::pair(&b, &ends.left_b)})
      for (const std::string& remark : left->remarks) printMessage(*path + ": " + remark);
    const SessionComparison found = comparisonOf(a, b, ends);
    if (out) {
      out->commit(comparisonHtml(found, comparisonPictures(ends)));
      return 0;
    }
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
