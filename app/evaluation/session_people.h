// Who says something in a session of an evaluation, and is asked: at a terminal, by a script, or on a page. Main
// thread; take() never waits.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/evaluation/evaluation_course.h"

namespace app {

struct Said {
  LogEvent event;     ///< time 0: of now
  std::string where;  ///< for messages; empty: its type
  /// Told what became of it: why it was refused, or nothing. May be empty.
  std::function<void(const std::optional<std::string>& refused)> answered = {};
};

/// Meant for a phase that had ended before.
struct Unsaid {
  std::string where, during;
};

class SessionPeople {
 public:
  virtual ~SessionPeople() = default;

  /// Since the last call: in a task that has lasted so long, or between two of them, `during` empty.
  virtual std::vector<Said> take(std::string_view during, double since_s) = 0;
  /// Tasks follow each other by themselves; else the evaluator begins each.
  virtual bool leads() const = 0;
  /// Once all tasks are done.
  virtual bool mayEndTasks() const { return true; }
  /// At the beginning of each phase. Returns when it has what it needs, or nobody is there to ask any more.
  virtual void ask(Phase phase) = 0;
  virtual std::vector<Unsaid> unsaid() const { return {}; }
};

}  // namespace app
