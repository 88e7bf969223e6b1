#include "app/rehearsal/interrupt.h"

#include <csignal>

#include "app/device/emergency_exit.h"

namespace app {
namespace {

volatile std::sig_atomic_t interrupted = 0;

}  // namespace

void installInterruptHandlers() {
  for (const int asked : {SIGINT, SIGTERM, SIGHUP})
    std::signal(asked, [](int) {
      if (interrupted) forbidForceNow();
      interrupted = 1;
    });
}

bool isInterrupted() noexcept { return interrupted != 0; }

}  // namespace app
