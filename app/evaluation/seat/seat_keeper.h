// Whole states of a process to go back to, by fork: what a servo remembers (bone, undo, ligaments, sites, plans) need
// not be written anywhere. keep() splits the process: the child goes on, the parent stays as it was and watches; where
// the child dies, or is stopped, another child goes on from the parent's state, some milliseconds later. A newer keep()
// lets the older parent go; the first one stays, as the one to whom others fall. Memory that nobody writes is shared.
// Linux. A process without other threads.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>

namespace app {

/// By a signal or a debugger.
bool isStopped(int process);

class SeatKeeper {
 public:
  /// Throws std::bad_alloc.
  SeatKeeper();

  /// Returns in the child, which must beat() from now on: false where another one did and died. The parent never
  /// returns: it does `first` once, as it is now, and exits with the child's status. After kMostDeaths since the last
  /// keep() it gives up.
  bool keep(const std::function<void()>& first = {});
  /// It works. Also adds its processor time.
  void beat();
  /// Of all children together.
  std::uint64_t processor_ns() const;

  static constexpr int kMostDeaths = 5, kGivenUp = 3;

 private:
  struct Shared {
    std::atomic<std::int64_t> beat_ns{0};
    std::atomic<std::uint64_t> processor_ns{0};
    std::atomic<int> newest{0}, deaths{0}, worker{0};
  };
  [[noreturn]] static void leave(int status);
  /// Returns when another child is needed.
  void watch(int number);
  void endSilent(double patience) const;

  Shared* shared_;
  bool is_first_ = true;
  std::uint64_t counted_ns_ = 0;  ///< of this process
};

}  // namespace app
