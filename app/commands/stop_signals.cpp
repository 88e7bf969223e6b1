#include "app/commands/stop_signals.h"

#include <signal.h>

#include <array>
#include <atomic>

namespace app {
namespace {

constexpr std::array kStops{SIGINT, SIGTERM, SIGHUP};
using Actions = std::array<struct sigaction, kStops.size()>;

/// Read by any thread.
std::atomic<int> stop_asked{0};
static_assert(std::atomic<int>::is_always_lock_free);
int stop_signals_alive = 0;

Actions handledBy(void (*handler)(int)) {
  Actions before{};
  struct sigaction stop {};
  stop.sa_handler = handler;
  for (std::size_t n = 0; n < kStops.size(); ++n) {
    ::sigaction(kStops[n], nullptr, &before[n]);
    // As nohup leaves it.
    const bool is_left = kStops[n] == SIGHUP && before[n].sa_handler == SIG_IGN;
    if (!is_left) ::sigaction(kStops[n], &stop, nullptr);
  }
  return before;
}

void restore(const Actions& before) {
  for (std::size_t n = 0; n < kStops.size(); ++n) ::sigaction(kStops[n], &before[n], nullptr);
}

}  // namespace

struct StopSignals::Before {
  Actions actions;
};

StopSignals::StopSignals() {
  // Within another, what it was asked is not forgotten.
  if (stop_signals_alive++ == 0) stop_asked = 0;
  before_ = std::make_unique<Before>(Before{handledBy([](int number) { stop_asked = number; })});
}
StopSignals::~StopSignals() {
  --stop_signals_alive;
  restore(before_->actions);
}

bool StopSignals::isAsked() const { return stop_asked != 0; }

int StopSignals::number() const { return stop_asked; }

}  // namespace app
