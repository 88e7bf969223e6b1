#include "app/evaluation/console/page_link.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "app/evaluation/child_process.h"
#include "app/evaluation/seat/seat_keeper.h"

namespace app {
namespace {

using LinkClock = std::chrono::steady_clock;

constexpr std::size_t kMostAnswers = 4096, kMostHeard = 1024;
constexpr std::chrono::milliseconds kLook{100}, kStoppedAfter{600}, kShortestPause{50}, kLongestPause{1000};
/// Of one that may just get no processor.
constexpr std::chrono::seconds kSilentAfter{20}, kSteady{10};
constexpr std::chrono::milliseconds kToEnd{500};

}  // namespace

class PageLink::Worker {
 public:
  explicit Worker(Parts parts) : parts_(std::move(parts)), greeting_(parts_.greeting) {
    wake_ = ::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    thread_ = std::thread([this] { run(); });
  }
  ~Worker() {
    {
      const std::scoped_lock lock(mutex_);
      ends_ = true;
    }
    wake();
    thread_.join();
    ::close(wake_);
  }

  void tellState(std::string text) {
    const std::scoped_lock lock(mutex_);
    state_ = std::move(text);
    is_state_new_ = true;
    wake();
  }
  void answer(std::string text) {
    const std::scoped_lock lock(mutex_);
    if (answers_.size() == kMostAnswers) answers_.pop_front();
    answers_.push_back(std::move(text));
    wake();
  }
  void greet(std::string text) {
    {
      const std::scoped_lock lock(mutex_);
      greeting_ = text;
    }
    answer(std::move(text));
  }
  std::vector<Heard> take() {
    const std::scoped_lock lock(mutex_);
    const bool was_full = heard_.size() >= kMostHeard;
    std::vector<Heard> taken = std::exchange(heard_, {});
    if (was_full) wake();
    return taken;
  }
  bool isStateSent() const {
    const std::scoped_lock lock(mutex_);
    return !is_state_new_;
  }
  std::vector<std::string> takeLosses() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(losses_, {});
  }
  Figures figures() const {
    const std::scoped_lock lock(mutex_);
    return figures_;
  }

 private:
  void wake() {
    constexpr std::uint64_t kRing = 1;
    [[maybe_unused]] const ssize_t rung = ::write(wake_, &kRing, sizeof kRing);
  }
  bool mustEnd() const {
    const std::scoped_lock lock(mutex_);
    return ends_;
  }
  bool mayHear() const {
    const std::scoped_lock lock(mutex_);
    return heard_.size() < kMostHeard;
  }

  void run() {
    while (!mustEnd()) {
      if (process_ <= 0 && LinkClock::now() >= start_at_) launch();
      waitForSomething();
      if (process_ <= 0) continue;
      hear();
      say();
      watch();
    }
    if (process_ > 0) endInOrder();
  }

  void waitForSomething() {
    std::array<pollfd, 2> all{pollfd{wake_, POLLIN, 0}, pollfd{words_, 0, 0}};
    if (words_ >= 0 && mayHear()) all[1].events |= POLLIN;
    if (words_ >= 0 && !out_.empty()) all[1].events |= POLLOUT;
    auto until = kLook;
    if (process_ <= 0) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(start_at_ - LinkClock::now());
      until = std::clamp(left + std::chrono::milliseconds(1), std::chrono::milliseconds(1), kLook);
    }
    ::poll(all.data(), words_ >= 0 ? 2 : 1, static_cast<int>(until.count()));
    std::uint64_t rings = 0;
    [[maybe_unused]] const ssize_t got = ::read(wake_, &rings, sizeof rings);
  }

  void launch() {
    std::array<int, 2> ends{-1, -1};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) return lose("no socket");
    words_ = ends[0];
    ::fcntl(words_, F_SETFL, ::fcntl(words_, F_GETFL) | O_NONBLOCK);
    std::vector<int> handed = parts_.handed;
    handed.insert(handed.end(), {parts_.listener, parts_.pictures, parts_.bell, ends[1]});
    std::vector<std::string> words{"molar",      "page",
                                   "--listener", std::to_string(parts_.listener),
                                   "--pictures", std::to_string(parts_.pictures),
                                   "--bell",     std::to_string(parts_.bell),
                                   "--words",    std::to_string(ends[1])};
    words.insert(words.end(), parts_.options.begin(), parts_.options.end());
    const int process = startBeside(parts_.program, std::move(words), handed);
    ::close(ends[1]);
    const std::scoped_lock lock(mutex_);
    if (process == 0) {
      ::close(std::exchange(words_, -1));
      start_at_ = LinkClock::now() + kLongestPause;
      return;
    }
    process_ = process;
    heard_at_ = started_at_ = LinkClock::now();
    reader_ = FrameReader(kMostUp);
    out_.clear();
    sent_ = 0;
    is_state_new_ = !state_.empty();
    if (!greeting_.empty()) out_ += framed(greeting_);
    ++figures_.starts;
    figures_.process = process;
  }

  void end() {
    if (words_ >= 0) ::close(std::exchange(words_, -1));
    endBeside(std::exchange(process_, 0));
  }

  /// Another follows: soon after one that lived, later after one that fell at once.
  void lose(std::string why) {
    end();
    const LinkClock::time_point now = LinkClock::now();
    pause_ = now - started_at_ > kSteady ? kShortestPause : std::min(2 * pause_, kLongestPause);
    start_at_ = now + pause_;
    const std::scoped_lock lock(mutex_);
    figures_.process = 0;
    constexpr std::size_t kMostLosses = 100;
    if (losses_.size() < kMostLosses) losses_.push_back(std::move(why));
  }

  void hear() {
    std::array<char, 16384> bytes;
    while (words_ >= 0 && mayHear()) {
      const ssize_t got = ::recv(words_, bytes.data(), bytes.size(), MSG_DONTWAIT);
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) return;
      if (got == 0) return lose("it has hung up");
      heard_at_ = LinkClock::now();
      bool is_sense = reader_.add(std::span(bytes.data(), static_cast<std::size_t>(got)));
      while (is_sense) {
        const auto text = reader_.next();
        if (!text) break;
        auto word = pageWordFrom(*text);
        is_sense = word.has_value();
        if (!is_sense) break;
        const std::scoped_lock lock(mutex_);
        heard_.push_back({std::move(*word), heard_at_.time_since_epoch().count()});
      }
      if (is_sense) continue;
      {
        const std::scoped_lock lock(mutex_);
        ++figures_.refused;
      }
      return lose("it says what cannot be");
    }
  }

  /// A text is in `out_` only while it is being sent: whoever is slow gets the newest state.
  void say() {
    for (;;) {
      if (out_.empty()) {
        const std::scoped_lock lock(mutex_);
        if (!answers_.empty()) {
          out_ = framed(answers_.front());
          answers_.pop_front();
        } else if (is_state_new_) {
          out_ = framed(state_);
          is_state_new_ = false;
        } else {
          return;
        }
      }
      const ssize_t sent = ::send(words_, out_.data() + sent_, out_.size() - sent_, MSG_DONTWAIT | MSG_NOSIGNAL);
      if (sent < 0 && errno == EINTR) continue;
      if (sent < 0) return;  // full, or it hung up: hear() finds that
      sent_ += static_cast<std::size_t>(sent);
      if (sent_ == out_.size()) out_.clear(), sent_ = 0;
    }
  }

  void watch() {
    if (process_ <= 0) return;
    siginfo_t ended{};
    if (::waitid(P_PID, static_cast<id_t>(process_), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 && ended.si_pid != 0)
      return lose("it has ended");
    const auto silent = LinkClock::now() - heard_at_;
    if (silent > kStoppedAfter && isStopped(process_)) return lose("it is stopped");
    if (silent > kSilentAfter) lose("it is silent");
  }

  void endInOrder() {
    // Its last state first.
    const LinkClock::time_point until = LinkClock::now() + kToEnd;
    bool is_told = false;
    while (words_ >= 0 && LinkClock::now() < until) {
      say();
      if (out_.empty() && !std::exchange(is_told, true)) {
        out_ = framed(R"({"kind":"end"})");
        say();
      }
      siginfo_t ended{};
      if (::waitid(P_PID, static_cast<id_t>(process_), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 && ended.si_pid != 0)
        break;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    end();
  }

  Parts parts_;
  int wake_ = -1, words_ = -1;
  pid_t process_ = 0;
  LinkClock::time_point start_at_{}, heard_at_{}, started_at_{};
  std::chrono::milliseconds pause_ = kShortestPause;
  FrameReader reader_{kMostUp};
  std::string out_;
  std::size_t sent_ = 0;

  mutable std::mutex mutex_;  ///< of all below
  std::string state_, greeting_;
  bool is_state_new_ = false, ends_ = false;
  std::deque<std::string> answers_;
  std::vector<Heard> heard_;
  std::vector<std::string> losses_;
  Figures figures_;
  std::thread thread_;  ///< last: it begins when all else is there
};

PageLink::PageLink(Parts parts) : worker_(std::make_unique<Worker>(std::move(parts))) {}
PageLink::~PageLink() = default;

void PageLink::tellState(std::string text) { worker_->tellState(std::move(text)); }
void PageLink::answer(std::string text) { worker_->answer(std::move(text)); }
void PageLink::greet(std::string text) { worker_->greet(std::move(text)); }
std::vector<PageLink::Heard> PageLink::take() { return worker_->take(); }
bool PageLink::isStateSent() const { return worker_->isStateSent(); }
std::vector<std::string> PageLink::takeLosses() { return worker_->takeLosses(); }
PageLink::Figures PageLink::figures() const { return worker_->figures(); }

}  // namespace app
