// A script in the place of people: says each line in its phase or task. Main thread.
#pragma once

#include <string_view>
#include <vector>

#include "app/evaluation/script.h"
#include "app/evaluation/session_clock.h"
#include "app/evaluation/session_people.h"

namespace app {

class ScriptPeople : public SessionPeople {
 public:
  /// Borrows course and clock.
  ScriptPeople(EvaluationScript script, EvaluationCourse& course, SessionClock& clock)
      : script_(std::move(script)), course_(course), clock_(clock) {}

  std::vector<Said> take(std::string_view during, double since_s) override;
  bool leads() const override { return true; }
  /// Throws UsageError: what it says is refused, by file and line.
  void ask(Phase phase) override;
  std::vector<Unsaid> unsaid() const override;

 private:
  EvaluationScript script_;
  EvaluationCourse& course_;
  SessionClock& clock_;
};

}  // namespace app
