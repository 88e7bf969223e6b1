// Events of a rehearsal, one line each, for the terminal and the recording. Main thread.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "app/station/workstation.h"
#include "app/text/message.h"

namespace app {

struct Notice {
  std::string kind, line;  ///< kind: "display", "device", "safety", …
  bool operator==(const Notice&) const = default;
};

class EventLog {
 public:
  /// From now on lines go to this recording, earlier ones now. Borrowed.
  void recordInto(Workstation& workstation) {
    workstation_ = &workstation;
    for (const Notice& notice : std::exchange(waiting_, {})) workstation.note(notice.kind, notice.line);
  }

  /// To the recording only.
  void note(const std::string& kind, const std::string& line) {
    if (workstation_ != nullptr)
      workstation_->note(kind, line);
    else
      waiting_.push_back({kind, line});
  }
  /// To terminal and recording.
  void report(const Notice& notice) {
    printMessage(notice.line);
    note(notice.kind, notice.line);
  }
  /// Reports lines of one kind; borrows this log.
  ReportLine reporter(const std::string& kind) {
    return [this, kind](const std::string& line) { report({kind, line}); };
  }

 private:
  Workstation* workstation_ = nullptr;
  std::vector<Notice> waiting_;
};

}  // namespace app
