#include "app/session/recorder.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <new>
#include <thread>
#include <utility>
#include <vector>

#include "app/session/session_error.h"
#include "app/session/session_writer.h"

namespace app {

namespace {

constexpr std::uint64_t kTickOfBatch = ~std::uint64_t{0};  // of an event whose tick nobody told

}  // namespace

struct Recorder::Impl {
  haptics::TickLog& log;

  // Shared with the callers, guarded by the mutex.
  mutable std::mutex mutex;
  std::condition_variable wake;
  bool stopping = false;
  std::vector<haptics::Command> pending_commands;
  std::vector<SessionEvent> events;
  std::string trouble;  ///< empty: none
  bool out_of_memory = false;

  // The recording thread's own.
  SessionWriter writer;
  const std::string first_file;
  const std::optional<std::string> temporary_file;
  TickTap* tap;
  SessionBatch batch;
  std::deque<haptics::Command> unconfirmed_commands;
  std::uint64_t serial_in_force, ticks_seen = 0, next_index = 0, gaps = 0;
  bool writing = true;

  std::optional<RecordingSummary> summary;
  std::thread thread;

  Impl(const std::string& path, bool overwrite, const SessionStart& start, haptics::TickLog& ticks, TickTap* told)
      : log(ticks),
        writer(path, overwrite, start),
        first_file(writer.file()),
        temporary_file(writer.replaces() ? std::optional(writer.file()) : std::nullopt),
        tap(told),
        serial_in_force(start.command.serial) {
    const SessionCommand first{start.command, 0};
    if (tap != nullptr) tap->take({&first, 1}, {});
  }

  void run() {
    for (bool last = false; !last;) {
      {
        std::unique_lock lock(mutex);
        wake.wait_for(lock, kBetweenWrites, [this] { return stopping; });
        last = stopping;
      }
      drain();
    }
  }

  void drain() noexcept {
    if (writing) attempt([this] { take(), trackTicks(), tell(), write(); });
    // After an early end the rest is counted as lost.
    if (!writing) ticks_seen += log.discard();
  }

  /// Ticks first: the command of each was queued before it was published.
  void take() {
    const std::scoped_lock lock(mutex);
    if (out_of_memory) throw std::bad_alloc();
    const std::size_t before = batch.ticks.size();
    log.drainInto(batch.ticks);
    ticks_seen += batch.ticks.size() - before;
    unconfirmed_commands.insert(unconfirmed_commands.end(), pending_commands.begin(), pending_commands.end());
    pending_commands.clear();
    for (SessionEvent& event : events) {
      if (event.tick == kTickOfBatch) event.tick = next_index;
      batch.events.push_back(std::move(event));
    }
    events.clear();
  }

  /// Finds first ticks of commands, and gaps.
  void trackTicks() {
    for (const haptics::Tick& tick : batch.ticks) {
      if (tick.index > next_index) {
        gaps += tick.index - next_index;
        batch.events.push_back({next_index, "lost", std::to_string(tick.index - next_index) + " ticks"});
      }
      if (tick.command_serial != serial_in_force) trackCommand(tick);
      next_index = tick.index + 1;
    }
  }

  /// Earlier commands were replaced before any tick used them.
  void trackCommand(const haptics::Tick& tick) {
    serial_in_force = tick.command_serial;
    const auto found = std::ranges::find(unconfirmed_commands, serial_in_force, &haptics::Command::serial);
    if (found == unconfirmed_commands.end()) {
      batch.events.push_back(
          {tick.index, "lost", "command " + std::to_string(serial_in_force) + " was never recorded"});
      return;
    }
    batch.commands.push_back({*found, tick.index});
    unconfirmed_commands.erase(unconfirmed_commands.begin(), found + 1);
  }

  void tell() noexcept {
    if (tap != nullptr && !batch.ticks.empty()) tap->take(batch.commands, batch.ticks);
  }

  /// Nothing is written before the first tick.
  void write() {
    const bool begun = writer.ticks() > 0 || !batch.ticks.empty();
    if (!begun || (batch.ticks.empty() && batch.events.empty())) return;
    writer.write(batch);
    batch.commands.clear(), batch.ticks.clear(), batch.events.clear();
  }

  /// Without a tick no file is kept.
  void close(const haptics::Bodies* final_bodies) noexcept {
    if (!writing) return;
    if (next_index == 0) return stopRecording("no tick came");
    attempt([&] {
      if (!batch.events.empty()) writer.write(batch);
      writer.seal(lost(), final_bodies);
    });
  }

  /// Only the log knows a gap that no later tick shows.
  std::uint64_t lost() const { return std::max(gaps, log.dropped()) + ticks_seen - writer.ticks(); }

  template <class Work>
  void attempt(Work&& work) noexcept {
    try {
      work();
    } catch (const std::bad_alloc&) {
      stopRecording("memory is out");
    } catch (const std::exception& failed) {
      stopRecording(failed.what());
    }
  }

  void stopRecording(const char* why) noexcept {
    writing = false;
    if (tap != nullptr) tap->end();
    const std::scoped_lock lock(mutex);
    try {
      trouble = std::string("the recording ended early: ") + why;
    } catch (const std::bad_alloc&) {
      trouble = "ended early";  // short enough to need no allocation
    }
  }
};

Recorder::Recorder(const std::string& path, bool overwrite, const SessionStart& start, haptics::TickLog& log,
                   DrainMode drain_mode, TickTap* tap)
    : impl_(std::make_unique<Impl>(path, overwrite, start, log, tap)) {
  if (drain_mode == DrainMode::by_thread) impl_->thread = std::thread([impl = impl_.get()] { impl->run(); });
}

Recorder::~Recorder() { stop(); }

const std::optional<std::string>& Recorder::temporaryFile() const { return impl_->temporary_file; }

const std::string& Recorder::firstFile() const { return impl_->first_file; }

void Recorder::command(const haptics::Command& command) noexcept {
  const std::scoped_lock lock(impl_->mutex);
  try {
    impl_->pending_commands.push_back(command);
  } catch (const std::bad_alloc&) {
    impl_->out_of_memory = true;  // a recording without it could not be replayed
  }
}

void Recorder::event(const std::string& kind, const std::string& text, std::optional<std::uint64_t> tick) noexcept {
  const std::scoped_lock lock(impl_->mutex);
  try {
    impl_->events.push_back({tick.value_or(kTickOfBatch), kind, text});
  } catch (const std::bad_alloc&) {
    impl_->out_of_memory = true;
  }
}

void Recorder::drain() noexcept { impl_->drain(); }

std::optional<std::string> Recorder::trouble() const {
  const std::scoped_lock lock(impl_->mutex);
  return impl_->trouble.empty() ? std::nullopt : std::optional(impl_->trouble);
}

RecordingSummary Recorder::stop(const haptics::Bodies* final_bodies) {
  if (impl_->summary) return *impl_->summary;
  {
    const std::scoped_lock lock(impl_->mutex);
    impl_->stopping = true;
  }
  impl_->wake.notify_one();
  if (impl_->thread.joinable())
    impl_->thread.join();
  else
    impl_->drain();
  impl_->close(final_bodies);
  impl_->summary = RecordingSummary{impl_->writer.ticks(), impl_->lost(), trouble(), impl_->writer.file()};
  return *impl_->summary;
}

}  // namespace app
