#include "app/evaluation/seat/seat.h"

#include <poll.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <memory>
#include <optional>
#include <utility>

#include "app/evaluation/child_process.h"
#include "app/evaluation/seat/follower.h"
#include "app/evaluation/seat/seat_arena.h"
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

/// All that a state is: it lies in the arena.
struct Followed {
  Followed(StoredStart start, const std::vector<std::string>& ids) : follower(std::move(start), ids) {}

  Follower follower;
  std::vector<std::optional<double>> said;
  std::uint64_t ticks = 0, place = 0;  ///< followed; of the feed, behind them
  double kept_s = 0.0;
  bool deviates = false;
};

class Seat {
 public:
  explicit Seat(const SeatOptions& options) : words_to_(options.words), states_(options.states), feed_(options.feed) {
    if (states_ >= 0 && SeatArena::open()) of_ = static_cast<Followed*>(SeatArena::bringBack(states_));
    is_brought_back_ = of_ != nullptr;
    if (is_brought_back_) {
      feed_.continueAt(of_->place);
      return;
    }
    const SeatArena::Inside inside;
    of_ = std::make_unique<Followed>(startOf(options.recording), options.ids).release();
  }
  ~Seat() { delete of_; }
  Seat(const Seat&) = delete;
  Seat& operator=(const Seat&) = delete;

  int run() {
    if (keep(false)) say({.kind = SeatWord::Kind::began, .tick = of_->ticks, .number = is_brought_back_ ? 2U : 0U});
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
    {
      const SeatArena::Inside inside;
      of_->follower.add(batch.commands);
    }
    for (std::size_t n = 0; n < batch.ticks.size(); ++n) {
      const FedTick& fed = batch.ticks[n];
      step(fed);
      sayValues();
      if (n % kBetweenBeats == 0) keeper_.beat();
      if (n + 1 == batch.ticks.size() || of_->ticks % kBetweenThroughs == 0) sayThrough();
    }
    of_->place = feed_.place();
    const double now_s = of_->follower.tick().t_s;
    if (now_s - of_->kept_s < kBetweenStates_s) return;
    of_->kept_s = now_s;
    keep(true);
  }

  void step(const FedTick& fed) {
    const SeatArena::Inside inside;
    const auto why = of_->follower.step(fed.input);
    ++of_->ticks;
    if (of_->deviates || (!why && digestOf(of_->follower.tick()) == fed.digest)) return;
    of_->deviates = true;
    say({.kind = SeatWord::Kind::deviates, .tick = fed.input.index});
  }

  /// All until here is said. False: this process goes on from here, as another one has died. The older half stores the
  /// state, for a process that knows nothing of these.
  bool keep(bool stores) {
    const bool is_whole = keeper_.keep([&] {
      if (stores && states_ >= 0) SeatArena::keep(states_, of_);
    });
    if (!is_whole) say({.kind = SeatWord::Kind::began, .tick = of_->ticks, .number = 1});
    send();
    return is_whole;
  }

  void sayValues() {
    const std::span<const std::optional<double>> values = of_->follower.measures().values();
    if (of_->said.size() != values.size()) {
      const SeatArena::Inside inside;
      of_->said.resize(values.size());
    }
    for (std::size_t n = 0; n < values.size(); ++n) {
      if (values[n] == of_->said[n]) continue;
      of_->said[n] = values[n];
      say({.kind = values[n] ? SeatWord::Kind::value : SeatWord::Kind::no_value,
           .tick = of_->follower.tick().index,
           .number = n,
           .value = values[n].value_or(0.0)});
    }
  }
  void sayThrough() {
    keeper_.beat();
    say({.kind = SeatWord::Kind::through, .tick = of_->follower.tick().index, .number = keeper_.processor_ns()});
    send();
  }
  void say(const SeatWord& word) {
    waiting_[waiting_count_++] = word;
    if (waiting_count_ == waiting_.size()) send();
  }

  /// Waits where the rehearsal is slow to read, and is at an end where that is gone.
  void send() {
    while (waiting_count_ > 0) {
      const ssize_t sent =
          ::send(words_to_, waiting_.data(), waiting_count_ * sizeof(SeatWord), MSG_DONTWAIT | MSG_NOSIGNAL);
      if (sent > 0) {
        waiting_count_ = 0;
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

  int words_to_, states_;
  InputFeedReader feed_;
  Followed* of_ = nullptr;
  SeatKeeper keeper_;
  std::array<SeatWord, kMostSeatWords> waiting_;
  std::size_t waiting_count_ = 0;
  bool is_brought_back_ = false;
};

}  // namespace

int runSeat(const SeatOptions& options) {
  if (options.states >= 0) SeatArena::startAtFixedAddresses();
  stepAside({options.recording, options.feed, options.words, options.states});
  return Seat(options).run();
}

}  // namespace app
