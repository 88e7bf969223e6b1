#include "app/commands/import_course.h"

#include <csignal>
#include <cstdio>
#include <filesystem>

#include <unistd.h>

#include <fmt/core.h>

#include "app/text/message.h"

namespace app {
namespace {

constexpr std::chrono::milliseconds kStopInterval{20};
constexpr std::string_view kStopped = "molar: import: stopped, nothing was imported\n";

/// The thread that works may still write into it.
void removeFolder(const std::string& folder) {
  constexpr int kTries = 200;
  std::error_code error;
  for (int n = 0; n < kTries && std::filesystem::exists(folder, error); ++n) {
    std::filesystem::remove_all(folder, error);
    if (error) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

}  // namespace

ImportCourse::ImportCourse() : on_terminal_(isatty(STDERR_FILENO) == 1) {}

double ImportCourse::now_s() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
}

void ImportCourse::begin(std::string_view stage) {
  end();
  const std::lock_guard lock(guard_);
  stages_.begin(stage, now_s());
}

void ImportCourse::end() {
  const std::lock_guard lock(guard_);
  const ImportStage* const running = stages_.running();
  if (running == nullptr) return;
  const auto n = running - stages_.all().data();
  stages_.end(now_s());
  if (on_terminal_) writeLine(stages_.all()[static_cast<std::size_t>(n)], now_s(), '\n');
}

void ImportCourse::abandon() {
  const std::lock_guard lock(guard_);
  if (stages_.running() == nullptr) return;
  stages_.end(now_s());
  clearLine();
}

void ImportCourse::say(const std::string& line) {
  const std::lock_guard lock(guard_);
  clearLine();
  printMessage(line);
}

void ImportCourse::removeIfStopped(const std::string& folder) {
  const std::lock_guard lock(guard_);
  to_remove_.push_back(folder);
}

void ImportCourse::leaveStopsToCaller(bool is_callers) {
  const std::lock_guard lock(guard_);
  is_callers_ = is_callers;
}

void ImportCourse::commit() {
  const std::lock_guard lock(guard_);
  is_committed_ = true;
}

ImportStages ImportCourse::stages() const {
  const std::lock_guard lock(guard_);
  return stages_;
}

void ImportCourse::drawLine() {
  const std::lock_guard lock(guard_);
  const ImportStage* const running = stages_.running();
  // Another program, and a server's messages, have the terminal to themselves.
  if (on_terminal_ && running != nullptr && running->usual_s > 0.0) writeLine(*running, now_s(), '\r');
}

void ImportCourse::clearLine() const {
  if (on_terminal_) std::fputs("\r\033[K", stderr);
}

void ImportCourse::writeLine(const ImportStage& stage, double at_s, char end) const {
  constexpr std::size_t kBar = 24;
  const auto full = static_cast<std::size_t>(stages_.shareOf(stage, at_s) * kBar);
  std::fputs(
      fmt::format("\r\033[K  {:16} [{}{}] {:6.1f} s   {:3.0f} % of all{}", stage.name, std::string(full, '#'),
                  std::string(kBar - full, '.'), stages_.secondsOf(stage, at_s), 100.0 * stages_.share(at_s), end)
          .c_str(),
      stderr);
  std::fflush(stderr);
}

void ImportCourse::stop(int signal_number) {
  const std::lock_guard lock(guard_);
  if (is_committed_ || is_callers_) return;
  for (const std::string& folder : to_remove_) removeFolder(folder);
  clearLine();
  const ssize_t ignored = ::write(STDERR_FILENO, kStopped.data(), kStopped.size());
  static_cast<void>(ignored);
  // As whoever waits for the program expects it.
  std::signal(signal_number, SIG_DFL);
  ::kill(::getpid(), signal_number);
  for (;;) ::pause();
}

ImportStopper::ImportStopper(const StopSignals& signals, ImportCourse& course)
    : thread_([this, &signals, &course] {
        while (!ends_) {
          if (signals.isAsked()) course.stop(signals.number());
          std::this_thread::sleep_for(kStopInterval);
        }
      }) {}

ImportStopper::~ImportStopper() {
  ends_ = true;
  thread_.join();
}

}  // namespace app
