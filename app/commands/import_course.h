// An import on its way, between the thread that works and those that show and stop it: which stage it is at, what it
// says, and what is to be removed if it is stopped. On a terminal each stage has a line with a bar and its seconds.
// A stop ends the program at once, with one line, and leaves nothing: what is computed cannot be asked to end.
// Any thread; each call under a lock, some microseconds.
#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "app/check_page/import_stages.h"
#include "app/check_page/import_view.h"
#include "app/commands/stop_signals.h"

namespace app {

class ImportCourse {
 public:
  ImportCourse();
  ~ImportCourse() { abandon(); }
  ImportCourse(const ImportCourse&) = delete;
  ImportCourse& operator=(const ImportCourse&) = delete;

  // The thread that works:
  void begin(std::string_view stage);
  void end();
  /// It does not come to its end.
  void abandon();
  /// A message to the person at the terminal.
  void say(const std::string& line);
  /// A folder that a stop removes.
  void removeIfStopped(const std::string& folder);
  /// While another program works, a stop is its caller's.
  void leaveStopsToCaller(bool is_callers);
  /// What a stop may not strike in its middle.
  std::unique_lock<std::recursive_mutex> whole() { return std::unique_lock(guard_); }
  /// Too late to be stopped.
  void commit();

  /// The scan as it is shown; not under the lock.
  ImportView& view() { return view_; }
  const ImportView& view() const { return view_; }

  // Those that show it:
  ImportStages stages() const;
  double now_s() const;
  /// Draws the line of the stage that is worked on.
  void drawLine();
  /// Does not return, unless it is too late or its caller's.
  void stop(int signal_number);

 private:
  void clearLine() const;
  void writeLine(const ImportStage& stage, double at_s, char end) const;

  mutable std::recursive_mutex guard_;
  bool on_terminal_ = false, is_committed_ = false, is_callers_ = false;
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
  ImportStages stages_{expectedImportStages()};
  std::vector<std::string> to_remove_;
  ImportView view_;
};

/// Stops it when a signal asks for that, whatever the other threads do: within 20 ms.
class ImportStopper {
 public:
  ImportStopper(const StopSignals& signals, ImportCourse& course);
  ~ImportStopper();
  ImportStopper(const ImportStopper&) = delete;
  ImportStopper& operator=(const ImportStopper&) = delete;

 private:
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

}  // namespace app
