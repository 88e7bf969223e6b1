#include "haptics/loop/realtime.h"

#include <linux/capability.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>

namespace haptics {
namespace {

/// More than any tick uses.
constexpr std::size_t kStack_bytes = 256 * 1024, kMinStack_bytes = 4096;

std::optional<int> lastAllowedCore() {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  if (pthread_getaffinity_np(pthread_self(), sizeof allowed, &allowed) != 0 || CPU_COUNT(&allowed) < 2) return {};
  for (int core = CPU_SETSIZE - 1; core >= 0; --core)
    if (CPU_ISSET(core, &allowed)) return core;
  return {};
}

bool mayPassMemoryLimits() {
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  __user_cap_data_struct capabilities[_LINUX_CAPABILITY_U32S_3]{};
  return syscall(SYS_capget, &header, capabilities) == 0 && (capabilities[0].effective & (1u << CAP_IPC_LOCK)) != 0;
}

bool isMemoryUnlimited() {
  rlimit limit{};
  return (getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur == RLIM_INFINITY) || mayPassMemoryLimits();
}

/// Locks the free part of this thread's stack, as much as the limit allows.
void lockOwnStack() {
  pthread_attr_t attributes;
  if (pthread_getattr_np(pthread_self(), &attributes) != 0) return;
  void* lowest = nullptr;
  std::size_t size = 0, guard = 0;
  if (pthread_attr_getstack(&attributes, &lowest, &size) == 0 && pthread_attr_getguardsize(&attributes, &guard) == 0) {
    auto* const here = static_cast<std::byte*>(__builtin_frame_address(0));
    const auto below = static_cast<std::size_t>(here - (static_cast<std::byte*>(lowest) + guard));
    std::size_t bytes = std::min(below, kStack_bytes);
    while (bytes > kMinStack_bytes && mlock(here - bytes, bytes) != 0) bytes /= 2;
  }
  pthread_attr_destroy(&attributes);
}

}  // namespace

RealtimeGrants requestRealtime(int priority) noexcept {
  RealtimeGrants grants;
  sched_param param{};
  param.sched_priority = priority;
  grants.priority = pthread_setschedparam(pthread_self(), SCHED_FIFO, &param) == 0;
  grants.memory_locked = isMemoryUnlimited() && mlockall(MCL_CURRENT | MCL_FUTURE) == 0;
  if (!grants.memory_locked) lockOwnStack();
  // Without priority a single core would wait for other threads on it.
  if (const auto core = lastAllowedCore(); core && grants.priority) {
    cpu_set_t only;
    CPU_ZERO(&only);
    CPU_SET(static_cast<unsigned>(*core), &only);
    if (pthread_setaffinity_np(pthread_self(), sizeof only, &only) == 0) grants.core = core;
  }
  return grants;
}

}  // namespace haptics
