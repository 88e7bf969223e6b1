#include "app/device/emergency_exit.h"

#include <signal.h>
#include <time.h>

#include <array>
#include <atomic>
#include <cassert>
#include <cstdlib>

namespace app {
namespace {

/// Fatal signals, without interrupts and SIGPIPE, which the program handles.
constexpr std::array kEnds = {SIGSEGV, SIGBUS,  SIGILL,  SIGFPE,  SIGABRT,   SIGQUIT, SIGTRAP, SIGSYS, SIGXCPU,
                              SIGXFSZ, SIGUSR1, SIGUSR2, SIGALRM, SIGVTALRM, SIGPROF, SIGIO,   SIGPWR, SIGSTKFLT};

std::atomic<haptics::DeviceLoop*> guarded{nullptr};
/// False from the begin of guarding until the motors are off.
std::atomic<bool> is_quiet{true};
std::atomic<bool> exit_is_watched{false};
std::atomic<std::int64_t> longest_wait_ms{0};

/// Previous handlers.
std::array<struct sigaction, kEnds.size()> former;
stack_t former_stack;

/// A separate stack, because the crash may be a stack overflow.
alignas(16) std::array<char, 64 * 1024> handler_stack;

template <class Condition>
void awaitUpTo(std::int64_t most_ms, const Condition& condition) {
  const timespec one_ms{0, 1'000'000};
  for (std::int64_t ms = 0; ms < most_ms && !condition(); ++ms) nanosleep(&one_ms, nullptr);
}

/// The first caller switches the motors off; others wait, so that the program does not end before.
void letGo(bool stops_device) {
  haptics::DeviceLoop* const loop = guarded.exchange(nullptr);
  if (loop == nullptr) {
    awaitUpTo(2 * longest_wait_ms.load(), [] { return is_quiet.load(); });
    return;
  }
  loop->disableForce();
  const std::uint64_t ticks = loop->ticks(), silences = loop->watchdogTrips();
  awaitUpTo(longest_wait_ms.load(), [&] { return loop->ticks() >= ticks + 2 || loop->watchdogTrips() > silences; });
  if (stops_device) loop->emergencyStop();
  is_quiet.store(true);
}

/// The program then ends as usual.
extern "C" void onEnd(int signal_number) {
  letGo(false);
  for (std::size_t i = 0; i < kEnds.size(); ++i)
    if (kEnds[i] == signal_number) sigaction(signal_number, &former[i], nullptr);
  raise(signal_number);
}

void onExit() { letGo(true); }

}  // namespace

void forbidForceNow() noexcept {
  if (haptics::DeviceLoop* loop = guarded.load()) loop->disableForce();
}

EmergencyExit::EmergencyExit(haptics::DeviceLoop& loop, std::chrono::milliseconds longest) {
  is_quiet.store(false);
  longest_wait_ms.store(longest.count());
  [[maybe_unused]] haptics::DeviceLoop* before = guarded.exchange(&loop);
  assert(before == nullptr);
  if (!exit_is_watched.exchange(true)) std::atexit(onExit);
  const stack_t stack{handler_stack.data(), 0, handler_stack.size()};
  sigaltstack(&stack, &former_stack);
  for (std::size_t i = 0; i < kEnds.size(); ++i) {
    struct sigaction action {};
    action.sa_handler = onEnd;
    action.sa_flags = SA_ONSTACK;
    sigaction(kEnds[i], &action, &former[i]);
    // An ignored signal does not end the program.
    if (former[i].sa_handler == SIG_IGN) sigaction(kEnds[i], &former[i], nullptr);
  }
}

EmergencyExit::~EmergencyExit() {
  guarded.store(nullptr);
  is_quiet.store(true);
  for (std::size_t i = 0; i < kEnds.size(); ++i) sigaction(kEnds[i], &former[i], nullptr);
  sigaltstack(&former_stack, nullptr);
}

}  // namespace app
