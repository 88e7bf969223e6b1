#include "assets/scan/confined_child.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

#include <fstream>

namespace assets {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kMemoryCanBeLimited = false;
#else
constexpr bool kMemoryCanBeLimited = true;
#endif

/// Data segment of the program, which the fork inherits.
std::uint64_t dataBytes() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t total = 0, resident = 0, shared = 0, text = 0, library = 0, data = 0;
  file >> total >> resident >> shared >> text >> library >> data;
  return data * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

itimerval onceAfter(std::uint32_t ms) { return {{0, 0}, {ms / 1000, 1000 * (ms % 1000)}}; }

}  // namespace

DefaultChildSignal::DefaultChildSignal() : before_(std::make_unique<struct sigaction>()) {
  struct sigaction standard {};
  standard.sa_handler = SIG_DFL;
  ::sigaction(SIGCHLD, &standard, before_.get());
}

DefaultChildSignal::~DefaultChildSignal() { ::sigaction(SIGCHLD, before_.get(), nullptr); }

void confineChild(std::uint64_t memory_bytes, std::optional<int> kept) {
  for (int number = 1; number < NSIG; ++number) ::signal(number, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  ::prctl(PR_SET_DUMPABLE, 0);
  if (kept) ::dup2(*kept, kKeptDescriptor);
  const int null = ::open("/dev/null", O_RDWR);
  for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(null, standard);
  ::close_range(static_cast<unsigned>(kept ? kKeptDescriptor : STDERR_FILENO) + 1, ~0U, 0);
  if (!kMemoryCanBeLimited) return;
  const std::uint64_t bytes = dataBytes() + memory_bytes;
  const rlimit memory{bytes, bytes};
  ::setrlimit(RLIMIT_DATA, &memory);
}

void limitChildTime(std::uint32_t processor_ms, std::uint32_t wait_ms) {
  const itimerval processor = onceAfter(processor_ms), wait = onceAfter(wait_ms);
  ::setitimer(ITIMER_PROF, &processor, nullptr);
  ::setitimer(ITIMER_REAL, &wait, nullptr);
}

}  // namespace assets
