// `molar manual` and `molar completion`: manual pages and bash completion, generated from the commands' own help.
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/commands/command.h"
#include "app/text/command_line.h"
#include "app/text/help_page.h"
#include "app/text/manual_page.h"
#include "app/text/shell_completion.h"
#include "app/text/suggestion.h"
#include "app/text/terminal_format.h"
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

/// The help of the command named by `words`, which are appended to `name`.
CommandHelp helpOf(const CommandLine& molar, const std::vector<std::string>& words, std::string& name) {
  CommandHelp help = molar.help();
  for (const std::string& requested : words) {
    CommandHelp found;
    std::vector<std::string> names;
    for (const CommandHelp& each : help.commands) {
      names.push_back(each.name);
      if (each.name == requested) found = each;
    }
    if (found.name.empty()) {
      const std::string suggestion = didYouMean(requested, names);
      throw UsageError(name + " has no command " + requested + (suggestion.empty() ? "," : suggestion) + " see " +
                       name + " --help");
    }
    help = found;
    name += " " + requested;
  }
  return help;
}

int manual(const CommandLine& molar, const ManualOptions& options) {
  std::string name = "molar";
  if (!options.into.empty()) {
    writePages(name, molar.help(), options);
    return 0;
  }
  const CommandHelp help = helpOf(molar, options.command, name);
  std::fputs(manualPage(name, help, programName()).c_str(), stdout);
  return 0;
}

}  // namespace

void addHelp(CommandLine& molar) {
  auto words = std::make_shared<std::vector<std::string>>();
  CommandLine& command = molar.command("help", "Explain a command: molar help rehearse");
  command.option("command", *words, "The command; none: the program").valueNamed("COMMAND");
  command.does([words, &molar] {
    std::string name = "molar";
    const CommandHelp help = helpOf(molar, *words, name);
    std::fputs(helpPage(name, help, terminalFormat()).c_str(), stdout);
    return 0;
  });
}

void addManual(CommandLine& molar) {
  auto o = std::make_shared<ManualOptions>();
  CommandLine& command =
      molar.command("manual", "Manual page of a command: molar manual rehearse | man -l -").forEngineers();
  Option path = command.option("command", o->command, "The command; none: the program").valueNamed("COMMAND");
  Option into = command.option("--into", o->into, "Write all pages into this folder instead").existingFolder();
  into.valueNamed("FOLDER").excludes(path);
  command.flag("--force", o->force, "Overwrite existing pages").needs(into);
  command.does([o, &molar] { return manual(molar, *o); });
}

void addCompletion(CommandLine& molar) {
  CommandLine& command =
      molar.command("completion", "Completion script for bash: source <(molar completion)").forEngineers();
  command.does([&molar] {
    std::fputs(bashCompletion("molar", molar.help()).c_str(), stdout);
    return 0;
  });
}

}  // namespace app
