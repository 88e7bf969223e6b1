// `molar seat`: the process beside a rehearsal, started by it.

#include <memory>

#include "app/commands/command.h"
#include "app/evaluation/seat/seat.h"
#include "app/evaluation/task_measures.h"
#include "app/text/command_line.h"
#include "app/text/usage_error.h"

namespace app {

void addSeat(CommandLine& molar) {
  auto options = std::make_shared<SeatOptions>();
  CommandLine& command =
      molar.command("seat", "Follows a rehearsal beside it; molar evaluate starts it where rules ask for the bone");
  command.forEngineers();
  command.option("--recording", options->recording, "Descriptor of the recording").wholeFrom(3, 1'000'000).required();
  command.option("--feed", options->feed, "Descriptor of what the servo is given").wholeFrom(3, 1'000'000).required();
  command.option("--words", options->words, "Descriptor to answer on").wholeFrom(3, 1'000'000).required();
  command.option("--states", options->states, "Descriptor of memory for states to go on from").wholeFrom(3, 1'000'000);
  command.option("--measures", options->ids, "Ids of measures of the bone, like O2.plan").separatedByCommas();
  command.does([options] {
    for (const std::string& id : options->ids)
      if (!needsBone(id)) throw UsageError("--measures " + id + ": is no measure of the bone, see molar metrics");
    return runSeat(*options);
  });
}

}  // namespace app
