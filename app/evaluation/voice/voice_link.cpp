#include "app/evaluation/voice/voice_link.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "app/evaluation/child_process.h"

namespace app {
namespace {

// Of one that may just get no processor.
constexpr std::chrono::seconds kSilent{60}, kLongestEnd{20};
constexpr int kPatience_ms = 50;

}  // namespace

VoiceLink::VoiceLink(VoiceOptions options, const SecretKey* secret, std::string program)
    : options_(std::move(options)), secret_(secret), program_(std::move(program)) {}

VoiceLink::~VoiceLink() { kill(); }

/// A pipe that holds it: on no command line, in no environment, on no disk. -1: there is none.
int VoiceLink::keyDescriptor() const {
  std::array<int, 2> ends{-1, -1};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return -1;
  const bool is_held = ::write(ends[1], secret_->data(), SecretKey::kBytes) == SecretKey::kBytes;
  ::close(ends[1]);
  if (is_held) return ends[0];
  ::close(ends[0]);
  return -1;
}

void VoiceLink::start() {
  ++starts_;
  is_over_ = true;
  std::array<int, 2> ends{-1, -1};
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) return;
  words_ = ends[0];
  std::vector<std::string> words{"molar", "voice", "--folder", options_.folder, "--words", std::to_string(ends[1])};
  std::vector<int> descriptors{ends[1]};
  if (!options_.file.empty()) words.insert(words.end(), {"--file", options_.file});
  if (options_.is_clock_told) words.emplace_back("--told");
  if (options_.played >= 0) {
    words.insert(words.end(), {"--played", std::to_string(options_.played)});
    descriptors.push_back(options_.played);
  }
  const int key = secret_ != nullptr ? keyDescriptor() : -1;
  if (key >= 0) {
    words.insert(words.end(), {"--key", std::to_string(key), "--session", options_.session});
    descriptors.push_back(key);
  }
  // What is to be sealed is not recorded unsealed.
  if (key >= 0 || secret_ == nullptr) process_ = startBeside(program_, std::move(words), descriptors);
  if (key >= 0) ::close(key);
  ::close(ends[1]);
  is_over_ = process_ == 0;
  heard_ = Clock::now();
}

void VoiceLink::kill() {
  if (words_ >= 0) ::close(std::exchange(words_, -1));
  endBeside(std::exchange(process_, 0));
  is_over_ = true;
}

void VoiceLink::tell(const VoiceWord& word) { ::send(words_, &word, sizeof word, MSG_DONTWAIT | MSG_NOSIGNAL); }

void VoiceLink::receive(std::vector<VoiceWord>& said) {
  while (words_ >= 0) {
    std::array<std::byte, sizeof(VoiceWord) + 1> datagram;
    const ssize_t got = ::recv(words_, datagram.data(), datagram.size(), MSG_DONTWAIT);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return;
    heard_ = Clock::now();
    const auto word = voiceWordFrom(std::span(datagram).first(static_cast<std::size_t>(got)));
    if (!word || word->kind >= VoiceWord::Kind::clock) continue;
    if (word->kind == VoiceWord::Kind::through) through_ns_ = std::max(through_ns_, word->t_ns);
    if (word->kind == VoiceWord::Kind::trouble || word->kind == VoiceWord::Kind::ended) is_over_ = true;
    said.push_back(*word);
  }
}

bool VoiceLink::hasDied() {
  siginfo_t ended{};
  return ::waitid(P_PID, static_cast<id_t>(process_), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 && ended.si_pid != 0;
}

void VoiceLink::watch() {
  if (is_over_ || process_ == 0) return;
  const bool is_silent = Clock::now() - heard_ > kSilent;
  if (!hasDied() && !is_silent) return;
  kill();
  if (starts_ < kMostStarts) start();
}

std::vector<VoiceWord> VoiceLink::update(std::int64_t now_ns) {
  std::vector<VoiceWord> said;
  receive(said);
  watch();
  if (!options_.is_clock_told || now_ns <= through_ns_) return said;
  int told = 0;
  while (!is_over_ && through_ns_ < now_ns) {
    if (told != starts_) tell({.kind = VoiceWord::Kind::clock, .t_ns = now_ns});
    told = starts_;
    pollfd words{words_, POLLIN, 0};
    ::poll(&words, 1, kPatience_ms);
    receive(said);
    watch();
  }
  return said;
}

VoiceFigures VoiceLink::finish(std::vector<VoiceWord>& said) {
  VoiceFigures figures;
  if (is_over_) return figures;
  tell({.kind = VoiceWord::Kind::end});
  const Clock::time_point until = Clock::now() + kLongestEnd;
  while (!is_over_ && Clock::now() < until) {
    pollfd words{words_, POLLIN, 0};
    ::poll(&words, 1, kPatience_ms);
    const bool has_died = hasDied();
    receive(said);
    if (has_died) break;
  }
  for (const VoiceWord& word : said)
    if (word.kind == VoiceWord::Kind::figure) figures[word.number] = word.value;
  kill();
  return figures;
}

}  // namespace app
