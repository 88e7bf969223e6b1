#include "app/evaluation/seat/seat.h"

#include <poll.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <optional>

#include "app/evaluation/child_process.h"
#include "app/evaluation/seat/follower.h"
#include "app/evaluation/seat/seat_keeper.h"
#include "app/evaluation/seat/seat_words.h"
#include "app/session/input_feed.h"
#include "app/session/session_error.h"
#include "app/session/session_reader.h"
#include "app/session/tick_columns.h"

namespace app {
namespace {

constexpr int kBetweenLooks_ms = 4;
constexpr std::size_t kBetweenBeats = 50, kBetweenThroughs = 250;  ///< ticks

/// A recording takes its final name some time after it was begun.
StoredStart startOf(int recording) {
  constexpr int kTries = 20;
  constexpr timespec kBetween{0, 50'000'000};
  const std::string path = "/proc/self/fd/" + std::to_string(recording);
  for (int n = 1;; ++n) try {
      return SessionReader::startWhileRecorded(path);
    } catch (const SessionError&) {
      if (n == kTries) throw;
      ::nanosleep(&kBetween, nullptr);
    }
}

class Seat {
 public:
  explicit Seat(const SeatOptions& options)
      : words_to_(options.words), feed_(options.feed), follower_(startOf(options.recording), options.ids) {}

  int run() {
    if (keep()) say({.kind = SeatWord::Kind::began});
    send();
    for (;;) {
      keeper_.beat();
      const std::optional<FedBatch> batch = feed_.next();
      if (batch) {
        follow(*batch);
        continue;
      }
      if (isRehearsalOver()) return 0;
    }
  }

 private:
  void follow(const FedBatch& batch) {
    follower_.add(batch.commands);
    for (std::size_t n = 0; n < batch.ticks.size(); ++n) {
      const FedTick& fed = batch.ticks[n];
      const auto why = follower_.step(fed.input);
      ++ticks_;
      if (!deviates_ && (why || digestOf(follower_.tick()) != fed.digest)) {
        deviates_ = true;
        say({.kind = SeatWord::Kind::deviates, .tick = fed.input.index});
      }
      sayValues();
      if (n % kBetweenBeats == 0) keeper_.beat();
      if (n + 1 == batch.ticks.size() || ticks_ % kBetweenThroughs == 0) sayThrough();
      const double now_s = follower_.tick().t_s;
      if (now_s - kept_s_ < kBetweenStates_s) continue;
      kept_s_ = now_s;
      sayThrough();
      keep();
    }
  }

  /// All until here is said. False: this process goes on from here, as another one has died.
  bool keep() {
    const bool is_whole = keeper_.keep();
    if (!is_whole) say({.kind = SeatWord::Kind::began, .tick = ticks_, .number = 1});
    send();
    return is_whole;
  }

  void sayValues() {
    const std::span<const std::optional<double>> values = follower_.measures().values();
    said_.resize(values.size());
    for (std::size_t n = 0; n < values.size(); ++n) {
      if (values[n] == said_[n]) continue;
      said_[n] = values[n];
      say({.kind = values[n] ? SeatWord::Kind::value : SeatWord::Kind::no_value,
           .tick = follower_.tick().index,
           .number = n,
           .value = values[n].value_or(0.0)});
    }
  }
  void sayThrough() {
    keeper_.beat();
    say({.kind = SeatWord::Kind::through, .tick = follower_.tick().index, .number = keeper_.processor_ns()});
    send();
  }
  void say(const SeatWord& word) {
    waiting_.push_back(word);
    if (waiting_.size() == kMostSeatWords) send();
  }

  /// Waits where the rehearsal is slow to read, and is at an end where that is gone.
  void send() {
    while (!waiting_.empty()) {
      const ssize_t sent =
          ::send(words_to_, waiting_.data(), waiting_.size() * sizeof(SeatWord), MSG_DONTWAIT | MSG_NOSIGNAL);
      if (sent > 0) {
        waiting_.clear();
      } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
        constexpr int kPatience_ms = 100;
        pollfd room{words_to_, POLLOUT, 0};
        ::poll(&room, 1, kPatience_ms);
        keeper_.beat();
      } else if (errno != EINTR) {
        ::_exit(0);
      }
    }
  }

  /// Waits a little; a rehearsal that waits itself says so.
  bool isRehearsalOver() const {
    pollfd other{words_to_, POLLIN, 0};
    if (::poll(&other, 1, kBetweenLooks_ms) != 1) return false;
    if ((other.revents & (POLLHUP | POLLERR)) != 0) return true;
    char nothing = 0;
    return ::recv(words_to_, &nothing, sizeof nothing, MSG_DONTWAIT) == 0;
  }

  int words_to_;
  InputFeedReader feed_;
  Follower follower_;
  SeatKeeper keeper_;
  std::vector<SeatWord> waiting_;
  std::vector<std::optional<double>> said_;
  std::uint64_t ticks_ = 0;
  double kept_s_ = 0.0;
  bool deviates_ = false;
};

}  // namespace

int runSeat(const SeatOptions& options) {
  stepAside({options.recording, options.feed, options.words});
  return Seat(options).run();
}

}  // namespace app
