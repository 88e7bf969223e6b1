#include "app/evaluation/script_people.h"

#include <limits>
#include <utility>

#include "app/text/usage_error.h"

namespace app {

std::vector<Said> ScriptPeople::take(std::string_view during, double since_s) {
  std::vector<Said> said;
  if (during.empty()) return said;
  for (ScriptedEvent& one : script_.takeDue(during, since_s))
    said.push_back({std::move(one.event), std::move(one.where)});
  return said;
}

void ScriptPeople::ask(Phase phase) {
  constexpr double kForever_s = std::numeric_limits<double>::infinity();
  constexpr double kSecond_ns = 1e9;
  // Before the consent nothing is said, and in tasks by their own names.
  if (phase == Phase::prepare || phase == Phase::tasks) return;
  const std::int64_t began_ns = clock_.now_ns();
  for (ScriptedEvent& one : script_.takeDue(kPhases[static_cast<std::size_t>(phase)], kForever_s)) {
    if (clock_.steps()) clock_.moveTo(began_ns + static_cast<std::int64_t>(one.at_s * kSecond_ns));
    one.event.t_ns = clock_.now_ns();
    if (const auto refused = course_.take(one.event)) throw UsageError(one.where + ": " + *refused);
  }
}

std::vector<Unsaid> ScriptPeople::unsaid() const {
  std::vector<Unsaid> left;
  for (const ScriptedEvent& one : script_.left()) left.push_back({one.where, one.during});
  return left;
}

}  // namespace app
