// The terminal of `molar evaluate`: keys read without waiting while a rehearsal runs, questions asked in lines before
// and after it. Nothing where standard input is no terminal. Main thread; microseconds a frame.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/evaluation/evaluator_keys.h"

namespace app {

/// A line that somebody types after a question on standard error; none: the end of the input.
std::optional<std::string> askedAtTerminal(const std::string& question);
bool isTerminalThere();

/// While it lives, keys arrive one by one and unseen.
class EvaluatorTerminal {
 public:
  explicit EvaluatorTerminal(std::vector<std::string> prompts);
  ~EvaluatorTerminal();
  EvaluatorTerminal(const EvaluatorTerminal&) = delete;
  EvaluatorTerminal& operator=(const EvaluatorTerminal&) = delete;

  /// What was said since the last call.
  std::vector<LogEvent> take(std::int64_t now_ns);

 private:
  struct Former;
  std::unique_ptr<Former> former_;
  EvaluatorKeys keys_;
};

}  // namespace app
