#include "app/rehearsal/journal.h"

#include <utility>

#include "app/text/said.h"

namespace app {

void Journal::keepIn(Workstation& workstation) {
  workstation_ = &workstation;
  for (const Notice& notice : std::exchange(waiting_, {})) workstation_->note(notice.kind, notice.line);
}

void Journal::note(const std::string& kind, const std::string& line) {
  if (workstation_ != nullptr)
    workstation_->note(kind, line);
  else
    waiting_.push_back({kind, line});
}

void Journal::tell(const Notice& notice) {
  say(notice.line);
  note(notice.kind, notice.line);
}

}  // namespace app
