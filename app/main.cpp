// molar COMMAND [options]: exit 0 success, 1 the answer is "no", 2 bad input in one line `molar: what, where, what to
// do`.

#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include <CLI/CLI.hpp>

#include "app/commands/command.h"

namespace {

/// Whatever a library said, people get one line.
std::string oneLine(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  for (char& c : text)
    if (c == '\n' || c == '\r') c = ' ';
  return text;
}

int refuse(const std::string& text) {
  std::fprintf(stderr, "molar: %s\n", oneLine(text).c_str());
  return 2;
}

int run(int argc, char** argv) {
  CLI::App molar{"Molar: rehearse a third-molar extraction, seen and felt. A training device, not a clinical one."};
  molar.require_subcommand(1);
  molar.set_version_flag("--version", MOLAR_VERSION);
  app::Chosen chosen;
  app::addRehearse(molar, chosen);
  app::addImport(molar, chosen);
  app::addInspect(molar, chosen);
  app::addFeel(molar, chosen);
  app::addCarve(molar, chosen);
  app::addSee(molar, chosen);
  app::addReplay(molar, chosen);
  app::addMetrics(molar, chosen);
  try {
    molar.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // Help and version are answers, everything else is a refusal.
    if (error.get_exit_code() == 0) return molar.exit(error);
    return refuse("command line: " + std::string(error.what()) + ", see molar --help or molar COMMAND --help");
  }
  return chosen.action();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::bad_alloc&) {
    return refuse("memory: there is not enough for this input, close other programs or use a smaller volume");
  } catch (const std::exception& error) {
    return refuse(error.what());
  }
}
