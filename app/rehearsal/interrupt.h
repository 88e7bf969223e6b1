// Ctrl-C, SIGTERM and SIGHUP end a rehearsal in order. The second time at the latest something hangs: then the force
// goes without it. Main thread; from obeyInterrupts() on.
#pragma once

namespace app {

void obeyInterrupts();
bool isInterrupted() noexcept;

}  // namespace app
