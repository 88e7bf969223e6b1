// The session's end of the page's process (`molar page`): starts it, hands states and answers down and takes what
// people say up, and starts another where it dies, is stopped or talks nonsense, on the same port. All that waits is
// done on a thread of its own; what the session calls takes a lock for microseconds. Nothing grows: of states the
// newest counts, answers and words are bounded. Linux.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "app/evaluation/console/page_words.h"

namespace app {

class PageLink {
 public:
  struct Parts {
    int listener = -1, pictures = -1, bell = -1;  ///< descriptors, borrowed
    std::vector<std::string> options;             ///< more of the command line
    std::vector<int> handed;                      ///< more descriptors, named there
    std::string greeting;                         ///< the first text that each process is told; empty: none
    std::string program = "/proc/self/exe";       ///< started as `PROGRAM page …`
  };
  explicit PageLink(Parts parts);
  /// Tells it to end, waits for that a moment, and ends it.
  ~PageLink();
  PageLink(const PageLink&) = delete;
  PageLink& operator=(const PageLink&) = delete;

  /// The whole of it; of those that were not sent yet the newest. What a new process is told first.
  void tellState(std::string text);
  /// To be sent in order. Beyond some thousand the oldest is lost, whoever waits for it asks again.
  void answer(std::string text);
  /// The text that each process is told first, from now on; told now as well.
  void greet(std::string text);

  struct Heard {
    PageWord word;
    std::int64_t at_ns = 0;  ///< steady clock, as it arrived
  };
  std::vector<Heard> take();
  /// The state that was told last is on its way: another may follow.
  bool isStateSent() const;
  /// Processes that were lost since the last call: why, a line each.
  std::vector<std::string> takeLosses();

  struct Figures {
    int starts = 0, process = 0;  ///< process 0: none
    std::uint64_t refused = 0;    ///< texts of nonsense
  };
  Figures figures() const;

 private:
  class Worker;
  std::unique_ptr<Worker> worker_;
};

}  // namespace app
