// The evaluator's keys at the terminal, beside the surgeon: 1 behaviour and 2 comment open a line, whose time is that
// of its first letter; Tab raises its severity, Enter keeps it, Esc drops it. 3 the marked prompt was said (+ marks the
// next), 4 bookmark, 5 the task: 1 success, 2 partly, 3 failed, each with a reason, 4 holds it and lets it go on, 5
// next. 6 help given, 7 problem
// ("name: sentence"), 8 a stream is withdrawn ("quotes"). Pure state; one thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/study/session_log.h"

namespace app {

inline constexpr std::string_view kEvaluatorKeys =
    "1 behaviour  2 comment  3 prompt said  4 bookmark  5 task (1 success 2 partly 3 failed 4 pause 5 next)  6 help  "
    "7 problem  8 withdraw";

class EvaluatorKeys {
 public:
  /// Ids of the template's prompts.
  explicit EvaluatorKeys(std::vector<std::string> prompts) : prompts_(std::move(prompts)) {}

  /// A byte as the terminal sends it, at its time. Returns what was said with it.
  std::optional<LogEvent> take(char c, std::int64_t t_ns);
  /// To be shown in the line of the terminal; empty: no line is open.
  std::string line() const;

 private:
  enum class Open : std::uint8_t { none, behaviour, comment, task, success, partly, failed, help, problem, withdrawal };
  std::optional<LogEvent> takeFree(char c, std::int64_t t_ns);
  void takeTask(char c);
  LogEvent said() const;

  std::vector<std::string> prompts_;
  std::size_t marked_ = 0;
  Open open_ = Open::none;
  std::string text_;
  int severity_ = 0;
  bool is_rated_ = false;
  std::int64_t began_ns_ = 0;
};

}  // namespace app
