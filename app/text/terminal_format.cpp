#include "app/text/terminal_format.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

namespace app {
namespace {

constexpr std::size_t kNarrowest = 60, kWidest = 110;

}  // namespace

TerminalFormat terminalFormat() {
  TerminalFormat format;
  if (isatty(STDOUT_FILENO) == 0) return format;
  const char* no_colour = std::getenv("NO_COLOR");
  format.coloured = no_colour == nullptr || *no_colour == '\0';
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
    format.width = std::clamp<std::size_t>(size.ws_col, kNarrowest, kWidest);
  return format;
}

}  // namespace app
