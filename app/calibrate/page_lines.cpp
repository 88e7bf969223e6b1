#include "app/calibrate/page_lines.h"

#include <algorithm>

namespace app {

std::vector<std::string> PageLines::newOf(const WizardView& view) {
  std::vector<std::string> lines;
  const auto tell = [&](std::string& former, std::string now) {
    if (now == former) return;
    former = std::move(now);
    if (!former.empty()) lines.push_back(former);
  };
  std::string page = "page: " + view.title + ". " + view.sentence;
  if (view.verdict) page += " " + view.verdict->sentence;
  // A page that comes again begins anew.
  if (page != page_) choice_.clear(), target_.clear();
  tell(message_, view.message.text.empty() ? "" : "said: " + view.message.text);
  tell(page_, page);
  tell(choice_, view.marked ? "choice: " + view.choices[*view.marked] + (view.value.empty() ? "" : ", " + view.value)
                            : std::string());
  const auto next = std::ranges::find(view.targets, TargetState::next, &ShownTarget::state);
  tell(target_, next == view.targets.end() || view.marked ? "" : "next: " + next->name + ", done " + view.count);
  return lines;
}

}  // namespace app
