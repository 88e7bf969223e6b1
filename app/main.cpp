// molar COMMAND [options]. Exit 0 success, 1 the answer is "no", 2 bad input, in one line `molar: what, where, what to
// do`.

#include <fcntl.h>
#include <poll.h>
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

constexpr std::size_t kMaxRefusal = 600;

/// Error messages of libraries may have several.
std::string oneLine(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  for (char& c : text)
    if (c == '\n' || c == '\r') c = ' ';
  if (text.size() > kMaxRefusal) text.replace(kMaxRefusal / 2, text.size() - kMaxRefusal, " … ");
  return text;
}

int refuse(const std::string& text) {
  app::printMessage(oneLine(calibration::withoutTemporaryNames(text)));
  return 2;
}

/// A closed standard stream's descriptor would be reused by the next file: opens /dev/null in its place.
void holdStandardStreams() {
  for (int fd = 0; fd <= 2; ++fd)
    if (fcntl(fd, F_GETFD) == -1 && open("/dev/null", O_RDWR) == -1) std::abort();
  std::signal(SIGPIPE, SIG_IGN);
}

/// A pipe whose reader has closed it, as `head` does.
bool isReaderGone() {
  pollfd output{STDOUT_FILENO, POLLOUT, 0};
  return poll(&output, 1, 0) == 1 && (output.revents & POLLERR) != 0;
}

int run(int argc, char** argv) {
  app::CommandLine molar(
      "Molar: rehearse a third-molar extraction, seen and felt. A training device, not a clinical one.",
      std::string(app::programBuild()));
  molar.example("molar rehearse", "the mouse is the handpiece; keys are listed by molar rehearse --help");
  for (const auto add : app::kCommands) add(molar);
  const int status = molar.run(argc, argv);
  if ((std::fflush(stdout) != 0 || std::ferror(stdout)) && !isReaderGone())
    return refuse("standard output: it cannot be written, check its destination");
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
