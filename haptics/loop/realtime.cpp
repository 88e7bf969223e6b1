#include "haptics/loop/realtime.h"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>

#include <algorithm>

namespace haptics {
namespace {

/// Below the kernel's own watchdogs and interrupt threads.
constexpr int kBelowTheTop = 10;

std::optional<int> lastAllowedCore() {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  if (pthread_getaffinity_np(pthread_self(), sizeof allowed, &allowed) != 0 || CPU_COUNT(&allowed) < 2) return {};
  for (int core = CPU_SETSIZE - 1; core >= 0; --core)
    if (CPU_ISSET(core, &allowed)) return core;
  return {};
}

}  // namespace

RealtimeGrants askForRealtime() noexcept {
  RealtimeGrants grants;
  sched_param param{};
  param.sched_priority =
      std::max(sched_get_priority_min(SCHED_FIFO), sched_get_priority_max(SCHED_FIFO) - kBelowTheTop);
  grants.priority = pthread_setschedparam(pthread_self(), SCHED_FIFO, &param) == 0;
  grants.memory_locked = mlockall(MCL_CURRENT | MCL_FUTURE) == 0;
  // Without priority a single core is a prison: whoever runs there is waited for.
  if (const auto core = lastAllowedCore(); core && grants.priority) {
    cpu_set_t only;
    CPU_ZERO(&only);
    CPU_SET(static_cast<unsigned>(*core), &only);
    if (pthread_setaffinity_np(pthread_self(), sizeof only, &only) == 0) grants.core = core;
  }
  return grants;
}

}  // namespace haptics
