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

#include "app/commands/command.h"
#include "app/text/command_line.h"
#include "app/text/message.h"
#include "app/text/version.h"
#include "calibration/output_file.h"

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
  app::printMessage(oneLine(calibration::withoutTemporaryNames(text)));
  return 2;
}

/// A closed standard stream would lend its number to the next file opened: give it to nowhere instead.
void holdStandardStreams() {
  for (int fd = 0; fd <= 2; ++fd)
    if (fcntl(fd, F_GETFD) == -1 && open("/dev/null", O_RDWR) == -1) std::abort();
  std::signal(SIGPIPE, SIG_IGN);
}

int run(int argc, char** argv) {
  app::CommandLine molar(
      "Molar: rehearse a third-molar extraction, seen and felt. A training device, not a clinical one.",
      std::string(app::programBuild()));
  for (const auto add : app::kCommands) add(molar);
  const int status = molar.run(argc, argv);
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
