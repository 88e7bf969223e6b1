// What processes that read strangers' files share: a fork that keeps nothing of the program and is limited, so that a
// file made to break a parser breaks that child alone. Any thread; a lock that another thread holds at the fork would
// stall the child until its time is over.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

struct sigaction;

namespace assets {

/// SIGCHLD has its default action in scope, so that waitpid tells how children end.
class DefaultChildSignal {
 public:
  DefaultChildSignal();
  ~DefaultChildSignal();
  DefaultChildSignal(const DefaultChildSignal&) = delete;
  DefaultChildSignal& operator=(const DefaultChildSignal&) = delete;

 private:
  std::unique_ptr<struct sigaction> before_;
};

/// Of the child's own descriptors the one that is kept, if any.
inline constexpr int kKeptDescriptor = 3;

/// In the child, first: no signal handler, file, or terminal of the program but `kept`, which becomes kKeptDescriptor;
/// no memory image on a crash; killed with its parent; at most `memory_bytes` more than it has (without a limit under a
/// sanitizer, which reserves terabytes).
void confineChild(std::uint64_t memory_bytes, std::optional<int> kept = {});

/// The process is ended by a signal after so much time of its processors, or by the clock. Again: from now on.
void limitChildTime(std::uint32_t processor_ms, std::uint32_t wait_ms);

}  // namespace assets
