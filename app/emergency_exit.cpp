#include "app/emergency_exit.h"

#include <signal.h>
#include <time.h>

#include <array>
#include <atomic>
#include <cassert>
#include <cstdlib>

namespace app {
namespace {

/// Whatever ends a program unless it is caught; interrupts and SIGPIPE are the program's own affair.
constexpr std::array kEnds = {SIGSEGV, SIGBUS,  SIGILL,  SIGFPE,  SIGABRT,   SIGQUIT, SIGTRAP, SIGSYS, SIGXCPU,
                              SIGXFSZ, SIGUSR1, SIGUSR2, SIGALRM, SIGVTALRM, SIGPROF, SIGIO,   SIGPWR, SIGSTKFLT};

/// Two ticks without force are enough; the supervisor needs 60 ms where none come.
constexpr int kLongestWait_ms = 120;

std::atomic<haptics::DeviceLoop*> guarded{nullptr};
std::atomic<bool> exit_is_watched{false};

/// A stack of its own, for a crash may be one of the stack.
alignas(16) std::array<char, 64 * 1024> handler_stack;

void quieten(haptics::DeviceLoop& loop) {
  loop.forbidForce();
  const std::uint64_t then = loop.ticks();
  const timespec one_ms{0, 1'000'000};
  for (int ms = 0; ms < kLongestWait_ms && loop.ticks() < then + 2; ++ms) nanosleep(&one_ms, nullptr);
}

extern "C" void onEnd(int signal_number) {
  if (haptics::DeviceLoop* loop = guarded.exchange(nullptr)) quieten(*loop);
  signal(signal_number, SIG_DFL);
  raise(signal_number);
}

void onExit() {
  if (haptics::DeviceLoop* loop = guarded.exchange(nullptr)) {
    quieten(*loop);
    loop->emergencyStop();
  }
}

}  // namespace

void forbidForceNow() noexcept {
  if (haptics::DeviceLoop* loop = guarded.load()) loop->forbidForce();
}

EmergencyExit::EmergencyExit(haptics::DeviceLoop& loop) {
  [[maybe_unused]] haptics::DeviceLoop* before = guarded.exchange(&loop);
  assert(before == nullptr);
  if (!exit_is_watched.exchange(true)) std::atexit(onExit);
  const stack_t stack{handler_stack.data(), 0, handler_stack.size()};
  sigaltstack(&stack, nullptr);
  for (int end : kEnds) {
    struct sigaction action {};
    action.sa_handler = onEnd;
    action.sa_flags = SA_ONSTACK;
    sigaction(end, &action, nullptr);
  }
}

EmergencyExit::~EmergencyExit() {
  guarded.store(nullptr);
  for (int end : kEnds) signal(end, SIG_DFL);
  const stack_t none{nullptr, SS_DISABLE, 0};
  sigaltstack(&none, nullptr);
}

}  // namespace app
