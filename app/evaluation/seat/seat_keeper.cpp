#include "app/evaluation/seat/seat_keeper.h"

#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <new>
#include <string>

namespace app {
namespace {

constexpr int kReplaced = 7;
constexpr std::int64_t kSecond_ns = 1'000'000'000, kLook_ns = 50'000'000;
constexpr double kStopped_s = 0.5, kSilent_s = 5.0;

std::int64_t clock_ns(clockid_t clock) {
  timespec t{};
  ::clock_gettime(clock, &t);
  return kSecond_ns * t.tv_sec + t.tv_nsec;
}

}  // namespace

bool isStopped(int process) {
  std::ifstream stat("/proc/" + std::to_string(process) + "/stat");
  std::string text;
  std::getline(stat, text);
  const std::size_t name_end = text.rfind(')');
  return name_end != std::string::npos && name_end + 2 < text.size() &&
         (text[name_end + 2] == 'T' || text[name_end + 2] == 't');
}

SeatKeeper::SeatKeeper() {
  void* const page = ::mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (page == MAP_FAILED) throw std::bad_alloc();
  shared_ = new (page) Shared;
}

void SeatKeeper::leave(int status) { ::_exit(status); }

bool SeatKeeper::keep(const std::function<void()>& first) {
  const bool is_first = is_first_;
  is_first_ = false;
  // Children of older parents fall to the first.
  if (is_first) ::prctl(PR_SET_CHILD_SUBREAPER, 1);
  const int number = is_first ? 0 : shared_->newest + 1;
  for (bool is_whole = true;; is_whole = false) {
    shared_->beat_ns = clock_ns(CLOCK_MONOTONIC);
    const pid_t child = ::fork();
    if (child == 0) {
      shared_->worker = ::getpid();
      counted_ns_ = 0;
      return is_whole;
    }
    // It goes on without: the older parent stays.
    if (child < 0 && !is_first) return true;
    if (child < 0) leave(kGivenUp);
    if (is_whole) shared_->newest = number, shared_->deaths = 0;
    if (is_whole && first) first();
    watch(number);
    if (++shared_->deaths > kMostDeaths) leave(kGivenUp);
  }
}

void SeatKeeper::watch(int number) {
  for (;;) {
    const timespec look{0, kLook_ns};
    int status = 0;
    const pid_t ended = ::waitpid(-1, &status, WNOHANG);
    if (ended > 0) {
      const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
      if (code == 0 || code == kGivenUp) leave(code);
      // To the first others fall: it looks whether one is left.
      if (code == kReplaced || number == 0) continue;
      return;
    }
    if (ended < 0 && errno == ECHILD) return;
    if (number != 0 && shared_->newest != number) leave(kReplaced);
    // The first leaves it to the newer one, if that lives.
    endSilent(number == 0 && shared_->newest != 0 ? 3.0 : 1.0);
    ::nanosleep(&look, nullptr);
  }
}

void SeatKeeper::endSilent(double patience) const {
  const double silent_s =
      static_cast<double>(clock_ns(CLOCK_MONOTONIC) - shared_->beat_ns) / static_cast<double>(kSecond_ns);
  const pid_t worker = shared_->worker;
  if (silent_s < patience * kStopped_s || worker <= 1 || ::getpgid(worker) != ::getpgrp()) return;
  if (silent_s > patience * kSilent_s || isStopped(worker)) ::kill(worker, SIGKILL);
}

void SeatKeeper::beat() {
  shared_->beat_ns = clock_ns(CLOCK_MONOTONIC);
  const auto now_ns = static_cast<std::uint64_t>(clock_ns(CLOCK_PROCESS_CPUTIME_ID));
  shared_->processor_ns += now_ns - counted_ns_;
  counted_ns_ = now_ns;
}

std::uint64_t SeatKeeper::processor_ns() const { return shared_->processor_ns; }

}  // namespace app
