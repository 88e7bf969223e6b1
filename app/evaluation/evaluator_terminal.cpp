#include "app/evaluation/evaluator_terminal.h"

#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <utility>

namespace app {
namespace {

/// A rehearsal takes them to end in order; a question is simply left.
class SignalsThatEnd {
 public:
  SignalsThatEnd() {
    for (std::size_t n = 0; n < kSignals.size(); ++n) former_[n] = std::signal(kSignals[n], SIG_DFL);
  }
  ~SignalsThatEnd() {
    for (std::size_t n = 0; n < kSignals.size(); ++n) std::signal(kSignals[n], former_[n]);
  }
  SignalsThatEnd(const SignalsThatEnd&) = delete;
  SignalsThatEnd& operator=(const SignalsThatEnd&) = delete;

 private:
  static constexpr std::array kSignals{SIGINT, SIGTERM, SIGHUP};
  std::array<void (*)(int), kSignals.size()> former_{};
};

}  // namespace

std::optional<std::string> askedAtTerminal(const std::string& question) {
  const SignalsThatEnd ending;
  std::fprintf(stderr, "%s ", question.c_str());
  std::string line;
  for (int c = std::getchar(); c != '\n'; c = std::getchar()) {
    if (c == EOF) return {};
    line += static_cast<char>(c);
  }
  return line;
}

bool isTerminalThere() { return isatty(STDIN_FILENO) != 0; }

struct EvaluatorTerminal::Former {
  termios settings{};
};

EvaluatorTerminal::EvaluatorTerminal(std::vector<std::string> prompts) : keys_(std::move(prompts)) {
  if (!isTerminalThere()) return;
  Former former;
  if (tcgetattr(STDIN_FILENO, &former.settings) != 0) return;
  termios by_key = former.settings;
  by_key.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  tcsetattr(STDIN_FILENO, TCSANOW, &by_key);
  former_ = std::make_unique<Former>(former);
}

EvaluatorTerminal::~EvaluatorTerminal() {
  if (former_) tcsetattr(STDIN_FILENO, TCSANOW, &former_->settings);
}

std::vector<LogEvent> EvaluatorTerminal::take(std::int64_t now_ns) {
  std::vector<LogEvent> said;
  if (!former_) return said;
  pollfd input{STDIN_FILENO, POLLIN, 0};
  std::array<char, 256> bytes{};
  while (poll(&input, 1, 0) == 1 && (input.revents & POLLIN) != 0) {
    const ssize_t count = read(STDIN_FILENO, bytes.data(), bytes.size());
    if (count <= 0) break;
    for (ssize_t n = 0; n < count; ++n)
      if (auto event = keys_.take(bytes[static_cast<std::size_t>(n)], now_ns)) said.push_back(std::move(*event));
    // The open line, over the one before.
    std::fprintf(stderr, "\r\033[K%s", keys_.line().c_str());
  }
  return said;
}

}  // namespace app
