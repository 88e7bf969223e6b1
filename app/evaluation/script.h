// The evaluator's and participant's side of a session without people, as JSON lines, for tests and demonstrations:
// {"during": "trough", "at_s": 2.0, "src": "evaluator", "type": "note", "data": {"kind": "behaviour", "text": "…"}}.
// `during`: a phase or a task; `at_s`: since that began; `for`: participants it is for, all where it is left out.
// Start-up only; plain values.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/evaluation/study_template.h"
#include "app/study/session_log.h"

namespace app {

struct ScriptedEvent {
  std::string during;
  double at_s = 0.0;
  LogEvent event;     ///< without its time
  std::string where;  ///< file and line, for messages
};

class EvaluationScript {
 public:
  EvaluationScript() = default;
  /// Lines for this participant, by phase in order of time. Throws UsageError with file and line.
  EvaluationScript(std::string_view text, const std::string& where, const StudyTemplate& study,
                   const std::string& participant);

  /// Due in this phase or task until then, each once.
  std::vector<ScriptedEvent> takeDue(std::string_view during, double until_s);
  /// Not taken yet: what was meant for a phase that ended before.
  const std::vector<ScriptedEvent>& left() const { return events_; }

 private:
  std::vector<ScriptedEvent> events_;
};

/// A file of at most 4 MiB. Throws LoadError, UsageError.
EvaluationScript evaluationScriptOf(const std::string& file, const StudyTemplate& study,
                                    const std::string& participant);

}  // namespace app
