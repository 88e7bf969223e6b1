// Runs another program to its end, without a shell; it and all that it starts are killed where it takes too long or
// this program is told to stop. Main thread.
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace app {

struct OutsideProgram {
  std::vector<std::string> words;          ///< its name, found along PATH, and what it is told
  std::vector<std::string> environment{};  ///< "NAME=value"; empty: ours
  bool is_silent = false;                  ///< else what it prints goes to standard error
  std::chrono::seconds limit{0};
};

struct OutsideEnd {
  enum class Kind { ended, not_started, late, stopped, unknown };
  Kind kind = Kind::ended;
  int status = 0;  ///< ended: of its exit, 128 and more for a signal; not_started: errno
};

OutsideEnd runToEnd(const OutsideProgram& program);

}  // namespace app
