// `molar start`: the start screen, for a desktop entry. What is chosen there goes through the parser and the action of
// `molar rehearse`, or of `molar check` for a patient that nobody has checked; after that the start screen is there
// again, with what went wrong, if anything did.

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
  addCheck(molar);
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

/// After the check page of a patient.
std::string wordsAfterCheck(const StartMenu& menu, const std::string& folder) {
  for (const StartChoice& choice : menu.lists()[static_cast<std::size_t>(StartListName::cases)].choices)
    if (choice.is_imported && choice.arguments.front() == folder)
      return choice.is_to_check
                 ? "What was found in " + choice.words + " is not confirmed: Start rehearses it as it is."
                 : choice.words + " is checked: Start begins its rehearsal.";
  return "";
}

int start() {
  // Looked at since the program began.
  std::vector<std::string> seen;
  StartMenu menu(startListsHere());
  menu.chooseAsIn(keptChoices());
  while (showStartScreen(menu, printMessage)) {
    keepChoices(menu.chosenWords());
    const std::vector<std::string> arguments = menu.arguments();
    const std::string trouble = troubleOf(arguments);
    if (wasInterrupted()) return 0;
    // The rehearsal's own would no longer end the program.
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);
    StartMenu next(startListsHere());
    next.chooseAsIn(menu.chosenWords());
    if (arguments.front() == "check" && trouble.empty()) seen.push_back(arguments.back());
    if (!trouble.empty())
      next.say(trouble, true);
    else if (arguments.front() == "check")
      next.say(wordsAfterCheck(next, arguments.back()), false);
    else if (next.newestSession() != menu.newestSession())
      next.say("Recorded, first in the list to go on with: " + inShort(next.newestSession()), false);
    for (const std::string& folder : seen) next.rehearseAsItIs(folder);
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
