// Evaluator and participant at the terminal where the command was started: keys while a rehearsal runs, questions in
// lines before and after it. Nobody where standard input is no terminal. Main thread.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/evaluation/evaluator_terminal.h"
#include "app/evaluation/session_clock.h"
#include "app/evaluation/session_people.h"

namespace app {

class TerminalPeople : public SessionPeople {
 public:
  struct Parts {
    const StudyTemplate& study;
    EvaluationCourse& course;
    const SessionClock& clock;
    const std::string& consent_text;
    std::string group;  ///< of the participant
  };
  /// Borrows all.
  explicit TerminalPeople(Parts parts) : parts_(std::move(parts)) {}

  std::vector<Said> take(std::string_view during, double since_s) override;
  bool leads() const override { return false; }
  void ask(Phase phase) override;

 private:
  Parts parts_;
  std::optional<EvaluatorTerminal> keys_;  ///< while tasks are done
};

}  // namespace app
