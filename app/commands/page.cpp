// `molar page`: the process that serves the evaluator's page, started by `molar evaluate --page`.

#include <memory>

#include "app/commands/command.h"
#include "app/evaluation/console/page_server.h"
#include "app/text/command_line.h"

namespace app {

void addPage(CommandLine& molar) {
  auto options = std::make_shared<PageOptions>();
  CommandLine& command = molar.command("page", "Serves the evaluator's page; molar evaluate --page starts it");
  command.forEngineers();
  constexpr int kLeast = 3, kMost = 1'000'000;
  command.option("--listener", options->listener, "Descriptor of the socket that listens")
      .wholeFrom(kLeast, kMost)
      .required();
  command.option("--pictures", options->pictures, "Descriptor of the pictures").wholeFrom(kLeast, kMost).required();
  command.option("--bell", options->bell, "Descriptor that tells of a new one").wholeFrom(kLeast, kMost).required();
  command.option("--words", options->words, "Descriptor of the session").wholeFrom(kLeast, kMost).required();
  command.option("--identity", options->identity, "Descriptor of certificate and key: the page is shared")
      .wholeFrom(kLeast, kMost);
  command.does([options] { return runPage(*options); });
}

}  // namespace app
