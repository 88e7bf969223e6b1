// `molar start`: the start screen, for a desktop entry. What is chosen there goes through the parser and the action of
// `molar rehearse`; after a rehearsal the start screen is there again, with what went wrong, if anything did.

#include <csignal>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "app/commands/command.h"
#include "app/rehearsal/rehearsal.h"
#include "app/session/metrics.h"
#include "app/start_screen/kept_choices.h"
#include "app/start_screen/show_start_screen.h"
#include "app/start_screen/start_lists.h"
#include "app/text/command_line.h"
#include "app/text/message.h"
#include "calibration/output_file.h"

namespace app {
namespace {

int runCommand(const std::vector<std::string>& arguments) {
  CommandLine molar("Molar", "");
  addRehearse(molar);
  std::vector<const char*> words{"molar"};
  for (const std::string& argument : arguments) words.push_back(argument.c_str());
  return molar.run(static_cast<int>(words.size()), words.data());
}

/// Why it did not run or is not whole; empty: it did.
std::string troubleOf(const std::vector<std::string>& arguments) {
  try {
    return runCommand(arguments) == 0
               ? ""
               : "The recording of this rehearsal is not whole: look at the free space on the disk.";
  } catch (const std::exception& error) {
    const std::string text = calibration::withoutTemporaryNames(error.what());
    printMessage(text);
    return text;
  }
}

/// Of the recording that was just closed.
std::string inShort(const std::string& session) {
  try {
    return metricsInShort(metricsOf(session));
  } catch (const std::exception& error) {
    return calibration::withoutTemporaryNames(error.what());
  }
}

int start() {
  StartMenu menu(startListsHere());
  menu.chooseAsIn(keptChoices());
  while (showStartScreen(menu, printMessage)) {
    keepChoices(menu.chosenWords());
    const std::string trouble = troubleOf(menu.arguments());
    if (wasInterrupted()) return 0;
    // The rehearsal's own would no longer end the program.
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);
    StartMenu next(startListsHere());
    next.chooseAsIn(menu.chosenWords());
    if (!trouble.empty())
      next.say(trouble, true);
    else if (next.newestSession() != menu.newestSession())
      next.say("Recorded, first in the list to go on with: " + inShort(next.newestSession()), false);
    menu = std::move(next);
  }
  return 0;
}

}  // namespace

void addStart(CommandLine& molar) {
  CommandLine& command =
      molar.command("start", "Start screen: case, device, calibration, patient's position, last sessions");
  command.does([] { return start(); });
}

}  // namespace app
