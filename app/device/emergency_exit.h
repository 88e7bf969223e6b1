// Whatever ends the program, the motors hear of it first. While one of these lives, a crash (SIGSEGV, SIGBUS, SIGILL,
// SIGFPE, SIGABRT and with it an uncaught exception), any other signal that would end the program (SIGQUIT, SIGUSR1,
// a limit of time or file size …), and exit() from anywhere, such as by the X library when the display is lost, forbid
// all force, wait until the device has ticked twice without any or the supervisor has switched off one that hangs, and
// only then go on to end the program as they would have. What a handler does is safe in one:
// atomics and nanosleep. SIGKILL and power cuts are the device's own business. One at a time (assert); made and
// destroyed by one thread. Interrupts (SIGINT, SIGTERM) end a rehearsal in order. Only the thread that makes it has a
// stack of its own for the handler.
#pragma once

#include <chrono>

#include "haptics/loop/device_loop.h"

namespace app {

class EmergencyExit {
 public:
  /// Two ticks without force are enough; the supervisor needs 60 ms where none come.
  static constexpr std::chrono::milliseconds kMaxShutdown{120};

  /// Borrows the loop. `longest`: that the program's end is held up.
  explicit EmergencyExit(haptics::DeviceLoop& loop, std::chrono::milliseconds longest = kMaxShutdown);
  ~EmergencyExit();
  EmergencyExit(const EmergencyExit&) = delete;
  EmergencyExit& operator=(const EmergencyExit&) = delete;
};

/// On the device that such a one guards, if there is one. A signal handler may call it.
void forbidForceNow() noexcept;

}  // namespace app
