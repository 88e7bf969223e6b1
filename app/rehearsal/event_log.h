// What is said to the person at the terminal and kept in the recording. Said before there is a recording, it is kept as
// soon as there is one. Main thread.
#pragma once

#include <string>
#include <vector>

#include "app/station/workstation.h"

namespace app {

/// A line of some kind: "display", "device", "safety", …
struct Notice {
  std::string kind, line;
  bool operator==(const Notice&) const = default;
};

class EventLog {
 public:
  /// From now on kept there, what was told before included. Borrowed.
  void recordInto(Workstation& workstation);

  void note(const std::string& kind, const std::string& line);
  /// Says and notes.
  void report(const Notice& notice);

 private:
  Workstation* workstation_ = nullptr;
  std::vector<Notice> waiting_;
};

}  // namespace app
