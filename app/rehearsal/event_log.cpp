#include "app/rehearsal/event_log.h"

#include <utility>

namespace app {

void EventLog::recordInto(Workstation& workstation) {
  workstation_ = &workstation;
  for (const Notice& notice : std::exchange(waiting_, {})) workstation_->note(notice.kind, notice.line);
}

void EventLog::note(const std::string& kind, const std::string& line) {
  if (workstation_ != nullptr)
    workstation_->note(kind, line);
  else
    waiting_.push_back({kind, line});
}

void EventLog::report(const Notice& notice) {
  printMessage(notice.line);
  note(notice.kind, notice.line);
}

}  // namespace app
