// One subcommand of `molar`: adds its options to the command line and returns the action to run when it is chosen.
// The action returns the exit status: 0 success, 1 the answer is "no". Bad input throws; main prints one line, exit 2.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace app {

using Action = std::function<int()>;

/// What main runs once the command line is parsed.
struct Chosen {
  Action action;
};

void addRehearse(CLI::App& molar, Chosen& chosen);
void addImport(CLI::App& molar, Chosen& chosen);
void addInspect(CLI::App& molar, Chosen& chosen);
void addFeel(CLI::App& molar, Chosen& chosen);
void addCarve(CLI::App& molar, Chosen& chosen);
void addSee(CLI::App& molar, Chosen& chosen);
void addDisplay(CLI::App& molar, Chosen& chosen);
void addCalibrate(CLI::App& molar, Chosen& chosen);
void addDevices(CLI::App& molar, Chosen& chosen);
void addDoctor(CLI::App& molar, Chosen& chosen);
void addReplay(CLI::App& molar, Chosen& chosen);
void addMetrics(CLI::App& molar, Chosen& chosen);
void addExport(CLI::App& molar, Chosen& chosen);
void addLaws(CLI::App& molar, Chosen& chosen);
void addPsychophysics(CLI::App& molar, Chosen& chosen);

}  // namespace app
