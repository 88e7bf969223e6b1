#include "haptics/loop/realtime.h"

#include <grp.h>
#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "haptics/device/thread_priority.h"

namespace haptics {
namespace {

/// Of address space, as mlockall counts it.
rlim_t programSize_bytes() {
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

rlim_t allowedLock_bytes() {
  rlimit limit{};
  getrlimit(RLIMIT_MEMLOCK, &limit);
  return limit.rlim_cur;
}

/// In a child that may lock so much, or as much as this machine allows: nobody in particular, for some may pass every
/// limit.
int underALimitOf(rlim_t most_bytes, int (*act)()) {
  const pid_t child = fork();
  if (child == 0) {
    rlimit limit{};
    getrlimit(RLIMIT_MEMLOCK, &limit);
    limit.rlim_cur = limit.rlim_max = std::min<rlim_t>(limit.rlim_max, most_bytes);
    if (setrlimit(RLIMIT_MEMLOCK, &limit) != 0) _exit(90);
    if (geteuid() == 0 && (setgroups(0, nullptr) != 0 || setgid(65534) != 0 || setuid(65534) != 0)) _exit(91);
    _exit(act());
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 99;
}

/// Enough for what the program has locked, not for later allocations.
int underAFiniteLimit(int (*act)()) { return underALimitOf(programSize_bytes() + (16u << 20), act); }

int failsToKeepItsStack() {
  long kB = -1;
  std::thread([&] {
    requestRealtime(kServoPriority);
    std::ifstream status("/proc/self/status");
    for (std::string word; kB < 0 && status >> word;)
      if (word == "VmLck:") status >> kB;
  }).join();
  // Half of what is allowed, less a page: no more is promised.
  const long least_kB = std::min<long>(128, static_cast<long>(allowedLock_bytes() / 2048) - 4);
  return kB >= least_kB && kB <= 1024 ? 0 : 3;
}

TEST(Realtime, LeavesRoomForLaterAllocationsWhereMemoryLocksAreLimited) {
  EXPECT_EQ(underAFiniteLimit([] {
              const RealtimeGrants grants = requestRealtime(kServoPriority);
              // Far more than may be locked.
              void* const later = std::malloc(256u << 20);
              return later == nullptr ? 1 : grants.memory_locked ? 2 : 0;
            }),
            0);
}

TEST(Realtime, KeepsItsStackWhereMemoryLocksAreLimited) { EXPECT_EQ(underAFiniteLimit(failsToKeepItsStack), 0); }

TEST(Realtime, KeepsAsMuchOfItsStackAsItMay) { EXPECT_EQ(underALimitOf(64u << 10, failsToKeepItsStack), 0); }

TEST(Realtime, TakesThePriorityItIsGiven) {
  constexpr int kAsked = 7;
  std::thread([] {
    const RealtimeGrants grants = requestRealtime(kAsked);
    int policy = 0;
    sched_param param{};
    pthread_getschedparam(pthread_self(), &policy, &param);
    EXPECT_EQ(policy == SCHED_FIFO, grants.priority);
    EXPECT_EQ(param.sched_priority, grants.priority ? kAsked : 0);
  }).join();
}

}  // namespace
}  // namespace haptics
