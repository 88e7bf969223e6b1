// Real-time settings of a thread: SCHED_FIFO, a core of its own, locked memory. Nothing is required; the result is
// reported. The core is the last one of the process, for interrupts and most programs start at the first; a machine
// with one core gives none. Start-up only.
#pragma once

#include <optional>

namespace haptics {

struct RealtimeGrants {
  bool priority = false;       ///< SCHED_FIFO
  bool memory_locked = false;  ///< mlockall, now and in future
  std::optional<int> core;     ///< the thread's only core
};

/// For the calling thread; `priority` is SCHED_FIFO's (device/thread_priority).
RealtimeGrants requestRealtime(int priority) noexcept;

}  // namespace haptics
