#include "app/evaluation/seat/seat_link.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <utility>

#include "app/evaluation/child_process.h"
#include "app/evaluation/seat/seat_arena.h"
#include "app/evaluation/seat/seat_keeper.h"

namespace app {
namespace {

// Of one that may just get no processor; whether it works is its keepers' to see.
constexpr std::chrono::seconds kToBegin{300}, kSilent{60};
constexpr std::chrono::milliseconds kStopped{500};
constexpr double kLate_ticks = 1000.0;

std::string joinedIds(const std::vector<std::string>& ids) {
  std::string joined;
  for (const std::string& id : ids) joined += (joined.empty() ? "" : ",") + id;
  return joined;
}

}  // namespace

SeatLink::SeatLink(const InputFeed& feed, std::vector<std::string> ids, std::string program)
    : feed_(feed), book_(std::move(ids)), program_(std::move(program)) {
  states_ = ::memfd_create("molar seat states", MFD_CLOEXEC);
  if (states_ >= 0 && ::ftruncate(states_, SeatArena::kStates_bytes) != 0) ::close(std::exchange(states_, -1));
}

SeatLink::~SeatLink() {
  end();
  if (recording_ >= 0) ::close(recording_);
  if (states_ >= 0) ::close(states_);
}

void SeatLink::start(const std::string& recording) {
  // Held open to the end: closing it would drop the locks of the database in this process.
  recording_ = ::open(recording.c_str(), O_RDONLY | O_CLOEXEC);
  launch();
}

void SeatLink::launch() {
  ++starts_;
  has_spoken_ = false;
  followed_at_launch_ = book_.followed();
  heard_ = Clock::now();
  std::array<int, 2> ends{-1, -1};
  if (recording_ < 0 || ::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    giveUp();
    return;
  }
  words_ = ends[0];
  std::vector<std::string> words{"molar",       "seat",
                                 "--recording", std::to_string(recording_),
                                 "--feed",      std::to_string(feed_.descriptor()),
                                 "--words",     std::to_string(ends[1])};
  if (!book_.ids().empty()) words.insert(words.end(), {"--measures", joinedIds(book_.ids())});
  std::vector<int> handed{recording_, feed_.descriptor(), ends[1]};
  if (states_ >= 0 && trusts_states_) {
    words.insert(words.end(), {"--states", std::to_string(states_)});
    handed.push_back(states_);
  }
  process_ = startBeside(program_, std::move(words), handed);
  ::close(ends[1]);
  if (process_ == 0) giveUp();
}

void SeatLink::end() {
  if (words_ >= 0) ::close(std::exchange(words_, -1));
  endBeside(std::exchange(process_, 0));
}

void SeatLink::begin(std::string why) {
  end();
  // What it had kept may be what it fell over.
  if (starts_ > 1 && book_.followed() <= followed_at_launch_) trusts_states_ = false;
  is_missed_ = true;
  news_.push_back({"seat.lost", {{"why", std::move(why)}}});
  if (starts_ == kMostStarts || feed_.hasEnded()) {
    giveUp();
    return;
  }
  launch();
}

void SeatLink::giveUp() {
  is_lost_ = true;
  news_.push_back({"seat.given_up", {{"starts", std::int64_t{starts_}}}});
}

void SeatLink::receive() {
  alignas(SeatWord) std::array<std::byte, (kMostSeatWords + 1) * sizeof(SeatWord)> datagram;
  while (words_ >= 0) {
    const ssize_t got = ::recv(words_, datagram.data(), datagram.size(), MSG_DONTWAIT | MSG_TRUNC);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return;
    heard_ = Clock::now();
    has_spoken_ = true;
    const auto size = std::min(datagram.size(), static_cast<std::size_t>(got));
    const auto words = seatWordsFrom(std::span(datagram).first(size));
    if (!words || !book_.take(*words, feed_.ticks())) return begin("it says what cannot be");
  }
}

void SeatLink::watch(std::uint64_t newest) {
  if (is_lost_ || process_ <= 0) return;
  siginfo_t ended{};
  if (::waitid(P_PID, static_cast<id_t>(process_), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 && ended.si_pid != 0)
    return begin("it has ended");
  const auto silent = Clock::now() - heard_;
  const bool is_late = static_cast<double>(newest + 1) - static_cast<double>(book_.followed()) > kLate_ticks;
  if (!is_late || silent < kStopped) return;
  if (isStopped(process_)) return begin("it is stopped");
  if (silent > (has_spoken_ ? kSilent : kToBegin)) begin("it is silent");
}

void SeatLink::update(std::uint64_t newest, std::chrono::milliseconds most_wait) {
  const Clock::time_point until = Clock::now() + most_wait;
  for (;;) {
    receive();
    watch(newest);
    tellNews();
    if (feed_.hasEnded()) is_lost_ = true;
    if (is_lost_ || followed() > newest || Clock::now() >= until) break;
    constexpr int kPatience_ms = 50;
    constexpr char kLook = 1;
    ::send(words_, &kLook, sizeof kLook, MSG_DONTWAIT | MSG_NOSIGNAL);
    pollfd words{words_, POLLIN, 0};
    ::poll(&words, 1, kPatience_ms);
  }
  constexpr std::uint64_t kUp_ticks = 100;
  const std::uint64_t lag = newest + 1 - std::min(newest + 1, followed());
  is_up_ = is_up_ || lag < kUp_ticks;
  if (is_up_) lags_.push_back(static_cast<std::uint32_t>(std::min<std::uint64_t>(lag, UINT32_MAX)));
}

void SeatLink::tellNews() {
  const auto back = [this](const char* how) {
    news_.push_back({"seat.back", {{"how", std::string(how)}, {"followed", static_cast<std::int64_t>(followed())}}});
  };
  if (book_.begun() > begun_told_ && std::exchange(is_missed_, false))
    back(book_.isBroughtBack() ? "from a stored state on" : "from the first tick on");
  begun_told_ = book_.begun();
  if (book_.takenOver() > taken_told_) back("from a kept state on, as its process died");
  taken_told_ = book_.takenOver();
  if (book_.deviates() && !std::exchange(has_told_deviation_, true))
    news_.push_back({"follower.desync", {{"tick", static_cast<std::int64_t>(*book_.deviates())}}});
}

std::vector<BoneSource::News> SeatLink::takeNews() { return std::exchange(news_, {}); }

SeatLink::Figures SeatLink::figures() const {
  Figures figures;
  figures.processor_s = static_cast<double>(book_.processor_ns()) * 1e-9;
  figures.starts = starts_;
  figures.taken_over = static_cast<int>(book_.takenOver());
  std::vector<std::uint32_t> lags = lags_;
  std::ranges::sort(lags);
  if (lags.empty()) return figures;
  figures.lag_p50_ticks = lags[lags.size() / 2];
  figures.lag_p99_ticks = lags[lags.size() * 99 / 100];
  return figures;
}

}  // namespace app
