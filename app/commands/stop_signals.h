// What SIGINT, SIGTERM and SIGHUP do to a command that leaves nothing half-done. Main thread; one within another.
#pragma once

#include <csignal>
#include <memory>

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
  /// Which one; 0: none.
  int number() const;

 private:
  struct Before;
  std::unique_ptr<Before> before_;
  assets::DefaultChildSignal child_;
};

}  // namespace app
