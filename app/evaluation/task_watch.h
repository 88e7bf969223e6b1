// Whether the rules of a task have fired, tick by tick: success and failure hold from one tick on for as long as the
// template asks, the time box ends. A pure function of ticks and commands: live and from the recording it fires at the
// same tick. One thread; task_measures' cost.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/evaluation/study_template.h"
#include "app/evaluation/task_measures.h"

namespace app {

enum class RuleVerdict : std::uint8_t { success, failed, time_box };
inline constexpr std::array<std::string_view, 3> kRuleVerdicts{"success", "failed", "time-box"};

struct RuleFired {
  RuleVerdict verdict = RuleVerdict::success;
  std::uint64_t tick = 0;     ///< the first of those that it held in
  std::uint64_t told_at = 0;  ///< the tick that made it hold long enough
  double time_s = 0.0;        ///< of the task at `tick`
  bool operator==(const RuleFired&) const = default;
};

/// Ids of the measures that the rules of a task name, each once.
std::vector<std::string> measuresOf(const TaskTemplate& task);
/// Those of all tasks that need the bone of their tick.
std::vector<std::string> boneMeasuresOf(const StudyTemplate& study);

class TaskWatch {
 public:
  /// Borrows both.
  TaskWatch(const TaskTemplate& task, const assets::RiskStructures& structures);

  /// Returns what fires with this tick. Success or failure is the last; the time box fires once, and the rules are
  /// looked at on. Failure wins where both hold long enough in one tick.
  std::optional<RuleFired> add(const haptics::Tick& tick, const haptics::Command& in_force, const BoneValue& bone = {});

  double time_s() const { return time_s_; }
  /// Of a measure that the rules name; none: not known yet.
  std::optional<double> measure(std::string_view id) const { return measures_.value(id); }
  /// "O1.removed 12.3 mm3 · S1.canal 2.1 mm"; what is not known yet is left out.
  std::string line() const;

 private:
  struct Since {
    std::uint64_t tick = 0;
    double time_s = 0.0;
  };
  std::optional<RuleFired> look(const Rule& rule, RuleVerdict verdict, std::optional<Since>& since,
                                const haptics::Tick& tick) const;

  const TaskTemplate& task_;
  TaskMeasures measures_;
  double time_s_ = 0.0;  ///< with the newest tick
  std::optional<Since> success_since_, failed_since_;
  bool is_decided_ = false, is_box_over_ = false;
};

}  // namespace app
