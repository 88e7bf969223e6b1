// What a thread that must not be late asks of the system: SCHED_FIFO, a core of its own, memory that stays. Nothing is
// required: what was granted is reported. The core is the last one the process may run on, for interrupts and most
// programs begin at the first; a machine with one core gives none away. Start-up only.
#pragma once

#include <optional>

namespace haptics {

struct RealtimeGrants {
  bool priority = false;       ///< SCHED_FIFO
  bool memory_locked = false;  ///< mlockall, now and in future
  std::optional<int> core;     ///< the thread runs there and nowhere else
};

/// For the calling thread; `priority` is SCHED_FIFO's (device/thread_priority).
RealtimeGrants requestRealtime(int priority) noexcept;

}  // namespace haptics
