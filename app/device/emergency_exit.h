// Switches the motors off before anything ends the program. While an object lives, a crash (SIGSEGV, SIGBUS, SIGILL,
// SIGFPE, SIGABRT, an uncaught exception), any other fatal signal (SIGQUIT, SIGUSR1, resource limits …) and exit(),
// such as from the X library when the display is lost, forbid all force, wait until the device has ticked twice without
// force or the supervisor has switched off one that hangs, and then end the program as usual. Handlers use only atomics
// and nanosleep. SIGKILL and power loss are left to the device; SIGINT and SIGTERM end a rehearsal in order. One object
// at a time (assert), made and destroyed by one thread; only that thread has a stack of its own for the handler.
#pragma once

#include <chrono>

#include "haptics/loop/device_loop.h"

namespace app {

class EmergencyExit {
 public:
  /// Two ticks without force are enough; the supervisor needs 60 ms where none come.
  static constexpr std::chrono::milliseconds kMaxShutdown{120};

  /// Borrows the loop. `longest`: delay of the program's end.
  explicit EmergencyExit(haptics::DeviceLoop& loop, std::chrono::milliseconds longest = kMaxShutdown);
  ~EmergencyExit();
  EmergencyExit(const EmergencyExit&) = delete;
  EmergencyExit& operator=(const EmergencyExit&) = delete;
};

/// For the guarded device, if any. A signal handler may call it.
void forbidForceNow() noexcept;

}  // namespace app
