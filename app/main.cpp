// molar COMMAND [options]: exit 0 success, 1 the answer is "no", 2 bad input in one line `molar: what, where, what to
// do`.

#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>

#include <CLI/CLI.hpp>

#include "app/commands/command.h"
#include "assets/output_file.h"

namespace {

constexpr std::size_t kLongestRefusal = 600;

/// Whatever a library said, people get one line.
std::string oneLine(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  for (char& c : text)
    if (c == '\n' || c == '\r') c = ' ';
  if (text.size() > kLongestRefusal) text.replace(kLongestRefusal / 2, text.size() - kLongestRefusal, " … ");
  return text;
}

int refuse(const std::string& text) {
  std::fprintf(stderr, "molar: %s\n", oneLine(assets::withoutTemporaryMarks(text)).c_str());
  return 2;
}

/// A closed standard stream would lend its number to the next file opened: give it to nowhere instead.
void holdStandardStreams() {
  for (int fd = 0; fd <= 2; ++fd)
    if (fcntl(fd, F_GETFD) == -1 && open("/dev/null", O_RDWR) == -1) std::abort();
  std::signal(SIGPIPE, SIG_IGN);
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
  app::addDisplay(molar, chosen);
  app::addCalibrate(molar, chosen);
  app::addDevices(molar, chosen);
  app::addDoctor(molar, chosen);
  app::addReplay(molar, chosen);
  app::addMetrics(molar, chosen);
  app::addExport(molar, chosen);
  app::addLaws(molar, chosen);
  app::addPsychophysics(molar, chosen);
  try {
    molar.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // Help and version are answers, everything else is a refusal.
    if (error.get_exit_code() == 0) return molar.exit(error);
    return refuse("command line: " + std::string(error.what()) + ", see molar --help or molar COMMAND --help");
  }
  const int status = chosen.action();
  if (std::fflush(stdout) != 0 || std::ferror(stdout))
    return refuse("standard output: the answer can not be written, check where it goes");
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  holdStandardStreams();
  try {
    return run(argc, argv);
  } catch (const std::bad_alloc&) {
    return refuse("memory: there is not enough for this input, close other programs or use a smaller volume");
  } catch (const std::exception& error) {
    return refuse(error.what());
  }
}
