// Ctrl-C, SIGTERM and SIGHUP end a rehearsal in order. At the second signal the force goes to zero at once. Main
// thread.
#pragma once

namespace app {

void installInterruptHandlers();
bool isInterrupted() noexcept;

}  // namespace app
