// What SIGINT, SIGTERM and SIGHUP do to a command that leaves nothing half-done. Main thread; one within another.
#pragma once

#include <csignal>
#include <memory>
#include <string_view>

#include "assets/scan/confined_child.h"

namespace app {

/// While it lives they only ask to stop, and how children end is told to nobody else.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  bool isAsked() const;

 private:
  struct Before;
  std::unique_ptr<Before> before_;
  assets::DefaultChildSignal child_;
};

/// While it lives they end the program as ever, after a line that says so: nothing is being written.
class StopsWithALine {
 public:
  /// `line` lives as long.
  explicit StopsWithALine(std::string_view line);
  ~StopsWithALine();
  StopsWithALine(const StopsWithALine&) = delete;
  StopsWithALine& operator=(const StopsWithALine&) = delete;

 private:
  struct Before;
  std::unique_ptr<Before> before_;
};

}  // namespace app
