#include "app/evaluation/child_process.h"

#include <sched.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <thread>

extern char** environ;

namespace app {
namespace {

constexpr std::chrono::milliseconds kMostOrderly{500};

}  // namespace

int startBeside(const std::string& program, std::vector<std::string> words, std::span<const int> descriptors) {
  posix_spawn_file_actions_t files;
  ::posix_spawn_file_actions_init(&files);
  // The same number: it stays open in the program.
  for (const int one : descriptors) ::posix_spawn_file_actions_adddup2(&files, one, one);
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  ::posix_spawnattr_setpgroup(&attributes, 0);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t process = 0;
  const int error = ::posix_spawn(&process, program.c_str(), &files, &attributes, arguments.data(), environ);
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&files);
  return error == 0 ? process : 0;
}

void endBeside(int process) {
  if (process <= 0) return;
  // In order, where it answers: a sound library that is killed while it starts leaves others waiting.
  ::kill(-process, SIGTERM);
  ::kill(-process, SIGCONT);
  const auto ends = std::chrono::steady_clock::now() + kMostOrderly;
  for (siginfo_t gone{}; std::chrono::steady_clock::now() < ends;) {
    if (::waitid(P_PID, static_cast<id_t>(process), &gone, WEXITED | WNOHANG | WNOWAIT) != 0 || gone.si_pid != 0) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  ::kill(-process, SIGKILL);
  ::waitpid(process, nullptr, 0);
}

void stepAside(std::vector<int> kept) {
  constexpr int kNice = 10;
  ::setpriority(PRIO_PROCESS, 0, kNice);
  std::ranges::sort(kept);
  unsigned first = 3;
  for (const int one : kept) {
    if (one < 3) continue;
    if (static_cast<unsigned>(one) > first) ::close_range(first, static_cast<unsigned>(one) - 1, 0);
    first = static_cast<unsigned>(one) + 1;
  }
  ::close_range(first, ~0U, 0);
  // The servo takes the last core, where it is given one (haptics/loop/realtime).
  cpu_set_t cores;
  CPU_ZERO(&cores);
  if (::sched_getaffinity(0, sizeof cores, &cores) != 0 || CPU_COUNT(&cores) < 2) return;
  int last = CPU_SETSIZE - 1;
  while (!CPU_ISSET(last, &cores)) --last;
  CPU_CLR(last, &cores);
  ::sched_setaffinity(0, sizeof cores, &cores);
}

}  // namespace app
