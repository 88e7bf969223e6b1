// `molar manual` and `molar completion`: manual pages and bash completion, generated from the commands' own help.
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/commands/command.h"
#include "app/text/command_line.h"
#include "app/text/manual_page.h"
#include "app/text/shell_completion.h"
#include "app/text/usage_error.h"
#include "app/text/version.h"
#include "calibration/output_file.h"

namespace app {
namespace {

struct ManualOptions {
  std::vector<std::string> command;
  std::string into;
  bool force = false;
};

std::string programName() { return "Molar " + std::string(programVersion()); }

void writePages(const std::string& name, const CommandHelp& command, const ManualOptions& options) {
  const auto path = std::filesystem::path(options.into) / manualFile(name);
  calibration::OutputFile file(path.string(), options.force);
  file.commit(manualPage(name, command, programName()));
  for (const CommandHelp& each : command.commands) writePages(name + " " + each.name, each, options);
}

int manual(const CommandLine& molar, const ManualOptions& options) {
  CommandHelp words = molar.help();
  std::string name = "molar";
  if (!options.into.empty()) {
    writePages(name, words, options);
    return 0;
  }
  for (const std::string& requested : options.command) {
    CommandHelp found;
    for (const CommandHelp& each : words.commands)
      if (each.name == requested) found = each;
    if (found.name.empty())
      throw UsageError("manual: " + name + " has no command " + requested + ", see " + name + " --help");
    words = found;
    name += " " + requested;
  }
  std::fputs(manualPage(name, words, programName()).c_str(), stdout);
  return 0;
}

}  // namespace

void addManual(CommandLine& molar) {
  auto o = std::make_shared<ManualOptions>();
  CommandLine& command = molar.command("manual", "Manual page of a command: molar manual rehearse | man -l -");
  Option path = command.option("command", o->command, "The command; none: the program").valueNamed("COMMAND");
  Option into = command.option("--into", o->into, "Write all pages into this folder instead").existingFolder();
  into.valueNamed("FOLDER").excludes(path);
  command.flag("--force", o->force, "Overwrite existing pages").needs(into);
  command.does([o, &molar] { return manual(molar, *o); });
}

void addCompletion(CommandLine& molar) {
  CommandLine& command = molar.command("completion", "Completion script for bash: source <(molar completion)");
  command.does([&molar] {
    std::fputs(bashCompletion("molar", molar.help()).c_str(), stdout);
    return 0;
  });
}

}  // namespace app
