#include "app/evaluation/voice/voice_process.h"

#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <deque>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "app/evaluation/child_process.h"
#include "app/evaluation/voice/delay_check.h"
#include "app/evaluation/voice/microphone.h"
#include "app/evaluation/voice/speech_watch.h"
#include "app/evaluation/voice/voice_files.h"
#include "app/evaluation/voice/voice_recorder.h"
#include "app/evaluation/voice/voice_words.h"
#include "app/text/usage_error.h"
#include "calibration/calibration_error.h"

namespace app {
namespace {

constexpr int kBetweenTakes_ms = 20;

double processor_s() {
  constexpr double kNano_s = 1e-9;
  timespec used{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
  return static_cast<double>(used.tv_sec) + static_cast<double>(used.tv_nsec) * kNano_s;
}

std::optional<VoiceSeal> sealOf(const VoiceOptions& options) {
  if (options.key < 0) return {};
  startSealing();
  VoiceSeal seal{SecretKey(), options.session};
  for (std::size_t at = 0; at < SecretKey::kBytes;) {
    const ssize_t got = ::read(options.key, seal.key.data() + at, SecretKey::kBytes - at);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) throw calibration::CalibrationError("the key of the voice was not given");
    at += static_cast<std::size_t>(got);
  }
  ::close(options.key);
  return seal;
}

class Voice {
 public:
  Voice(const VoiceOptions& options, std::unique_ptr<Microphone> microphone)
      : options_(options),
        microphone_(std::move(microphone)),
        folder_(options.folder, sealOf(options)),
        recorder_({[this](std::uint64_t number, std::span<const float> samples) { folder_.store(number, samples); },
                   [this](const ClockRow& row) { folder_.add(row); }},
                  folder_.takePast()),
        watch_(options.played,
               {[this](const SpeechChange& change) {
                  say({.kind = VoiceWord::Kind::speech, .t_ns = change.t_ns, .number = change.speaks ? 1U : 0U});
                },
                [this](std::int64_t t_ns, double level_db) { sayLevel(t_ns, level_db); }}) {}

  int run() {
    say({.kind = VoiceWord::Kind::began});
    if (options_.file.empty()) delay_ = std::make_unique<DelayCheck>();
    while (!ends_) {
      listen();
      send();
      take();
    }
    finish();
    return 0;
  }

 private:
  std::int64_t now_ns() const {
    return options_.is_clock_told ? told_ns_ : std::chrono::steady_clock::now().time_since_epoch().count();
  }

  void listen() {
    if (options_.is_clock_told && told_ns_ == 0) return;
    heard_.clear();
    microphone_->takeInto(heard_, now_ns());
    for (const HeardBlock& block : heard_) {
      recorder_.add(block);
      watch_.add(block);
    }
    if (delay_ && !delay_->isDone()) {
      delay_->follow(recorder_, now_ns());
      if (delay_->isDone()) start_ms_ = delay_->delay_ms();
    }
    if (options_.is_clock_told && told_ns_ != answered_ns_) {
      answered_ns_ = told_ns_;
      say({.kind = VoiceWord::Kind::through, .t_ns = told_ns_});
    }
  }

  void sayLevel(std::int64_t t_ns, double level_db) {
    // Of the newest alone, where nobody listens.
    if (!waiting_.empty() && waiting_.back().kind == VoiceWord::Kind::level) waiting_.pop_back();
    constexpr double kThousand = 1000.0;
    say({.kind = VoiceWord::Kind::level,
         .t_ns = t_ns,
         .number = static_cast<std::uint64_t>(watch_.green_s() * kThousand + 0.5),
         .value = level_db});
  }
  void say(const VoiceWord& word) { waiting_.push_back(word); }

  void send() {
    while (!waiting_.empty()) {
      if (::send(options_.words, &waiting_.front(), sizeof(VoiceWord), MSG_DONTWAIT | MSG_NOSIGNAL) > 0) {
        waiting_.pop_front();
        continue;
      }
      if (errno == EINTR) continue;
      if (errno != EAGAIN && errno != EWOULDBLOCK) ends_ = is_alone_ = true;
      return;
    }
  }
  /// Until all is said, or nobody is there.
  void flush() {
    for (send(); !waiting_.empty() && !is_alone_; send()) {
      pollfd room{options_.words, POLLOUT, 0};
      ::poll(&room, 1, kBetweenTakes_ms);
    }
  }

  /// Waits a little. A session that is gone is at its end.
  void take() {
    pollfd other{options_.words, POLLIN, 0};
    if (::poll(&other, 1, kBetweenTakes_ms) != 1) return;
    for (;;) {
      std::array<std::byte, sizeof(VoiceWord) + 1> datagram;
      const ssize_t got = ::recv(options_.words, datagram.data(), datagram.size(), MSG_DONTWAIT);
      if (got < 0 && (errno == EAGAIN || errno == EINTR)) return;
      if (got <= 0) {
        ends_ = is_alone_ = true;
        return;
      }
      const auto word = voiceWordFrom(std::span(datagram).first(static_cast<std::size_t>(got)));
      if (!word) continue;
      if (word->kind == VoiceWord::Kind::clock && word->t_ns > told_ns_) told_ns_ = word->t_ns;
      if (word->kind == VoiceWord::Kind::end) ends_ = true;
      // Each time that is told has its answer.
      if (word->kind == VoiceWord::Kind::clock) return;
    }
  }

  void finish() {
    if (options_.is_clock_told) listen();
    std::optional<double> end_ms;
    if (options_.file.empty() && !is_alone_) {
      delay_ = std::make_unique<DelayCheck>();
      while (!delay_->isDone()) {
        listen();
        flush();
        constexpr timespec kPause{0, 20'000'000};
        ::nanosleep(&kPause, nullptr);
      }
      end_ms = delay_->delay_ms();
    }
    listen();
    microphone_.reset();
    recorder_.finish();
    const auto figure = [this](VoiceFigure which, double value) {
      say({.kind = VoiceWord::Kind::figure, .number = static_cast<std::uint64_t>(which), .value = value});
    };
    figure(VoiceFigure::seconds, static_cast<double>(recorder_.frames()) / kVoiceRate_Hz);
    figure(VoiceFigure::segments, static_cast<double>(folder_.segments()));
    figure(VoiceFigure::gaps, static_cast<double>(recorder_.gaps()));
    figure(VoiceFigure::drift_ppm, recorder_.map().drift_ppm());
    figure(VoiceFigure::speech_s, watch_.speech_s());
    if (start_ms_) figure(VoiceFigure::delay_start_ms, *start_ms_);
    if (end_ms) figure(VoiceFigure::delay_end_ms, *end_ms);
    figure(VoiceFigure::processor_s, processor_s());
    say({.kind = VoiceWord::Kind::ended});
    flush();
  }

  VoiceOptions options_;
  std::unique_ptr<Microphone> microphone_;
  VoiceFolder folder_;
  VoiceRecorder recorder_;
  SpeechWatch watch_;
  std::unique_ptr<DelayCheck> delay_;
  std::optional<double> start_ms_;
  std::vector<HeardBlock> heard_;
  std::deque<VoiceWord> waiting_;
  std::int64_t told_ns_ = 0, answered_ns_ = 0;
  bool ends_ = false, is_alone_ = false;
};

void sayTrouble(int words, VoiceTrouble trouble) {
  const VoiceWord word{.kind = VoiceWord::Kind::trouble, .number = static_cast<std::uint64_t>(trouble)};
  ::send(words, &word, sizeof word, MSG_NOSIGNAL);
}

}  // namespace

int runVoice(const VoiceOptions& options) {
  stepAside({options.words, options.played, options.key});
  // Whoever ends it waits until the sound libraries have started: one that is killed meanwhile leaves a file behind,
  // for which every later start waits.
  sigset_t end;
  ::sigemptyset(&end);
  ::sigaddset(&end, SIGTERM);
  ::sigprocmask(SIG_BLOCK, &end, nullptr);
  try {
    // First: without one there is no folder either.
    auto microphone = options.file.empty() ? openMicrophone([](const std::string&) {}) : fileMicrophone(options.file);
    ::sigprocmask(SIG_UNBLOCK, &end, nullptr);
    if (microphone) return Voice(options, std::move(microphone)).run();
    sayTrouble(options.words, VoiceTrouble::no_microphone);
    return 0;
  } catch (const calibration::CalibrationError&) {
    sayTrouble(options.words, VoiceTrouble::disk);
  } catch (const UsageError&) {
    sayTrouble(options.words, VoiceTrouble::sound);
  }
  return 1;
}

}  // namespace app
