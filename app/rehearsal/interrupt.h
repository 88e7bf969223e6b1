// Ctrl-C, SIGTERM and SIGHUP end a rehearsal in order. The second time at the latest something hangs: then the force
// goes without it. Main thread; from installInterruptHandlers() on.
#pragma once

namespace app {

void installInterruptHandlers();
bool isInterrupted() noexcept;

}  // namespace app
