#include "app/evaluation/task_watch.h"

#include <algorithm>

#include <fmt/core.h>

namespace app {
namespace {

constexpr double kRounding_s = 1e-9;  ///< of sums of dt

}  // namespace

std::vector<std::string> measuresOf(const TaskTemplate& task) {
  std::vector<std::string> ids = task.success.measures();
  if (task.fail)
    for (const std::string& id : task.fail->measures())
      if (std::ranges::find(ids, id) == ids.end()) ids.push_back(id);
  return ids;
}

std::vector<std::string> boneMeasuresOf(const StudyTemplate& study) {
  std::vector<std::string> ids;
  for (const TaskTemplate& task : study.tasks)
    for (const std::string& id : measuresOf(task))
      if (needsBone(id) && std::ranges::find(ids, id) == ids.end()) ids.push_back(id);
  return ids;
}

TaskWatch::TaskWatch(const TaskTemplate& task, const assets::RiskStructures& structures)
    : task_(task), measures_(structures, measuresOf(task)) {}

std::optional<RuleFired> TaskWatch::look(const Rule& rule, RuleVerdict verdict, std::optional<Since>& since,
                                         const haptics::Tick& tick) const {
  const auto holds = rule.holds([this](std::string_view id) { return measures_.value(id); });
  if (!holds.value_or(false)) {
    since.reset();
    return {};
  }
  if (!since) since = Since{tick.index, time_s_};
  if (time_s_ - since->time_s + kRounding_s < task_.hold_s) return {};
  return RuleFired{verdict, since->tick, tick.index, since->time_s};
}

std::optional<RuleFired> TaskWatch::add(const haptics::Tick& tick, const haptics::Command& in_force,
                                        const BoneValue& bone) {
  if (is_decided_) return {};
  time_s_ += tick.dt_s;
  measures_.add(tick, in_force, bone);
  std::optional<RuleFired> fired;
  if (task_.fail) fired = look(*task_.fail, RuleVerdict::failed, failed_since_, tick);
  const auto success = look(task_.success, RuleVerdict::success, success_since_, tick);
  if (!fired) fired = success;
  is_decided_ = fired.has_value();
  if (fired || is_box_over_ || time_s_ + kRounding_s < task_.time_box_s) return fired;
  is_box_over_ = true;
  return RuleFired{RuleVerdict::time_box, tick.index, tick.index, time_s_};
}

std::string TaskWatch::line() const {
  std::string line;
  for (const std::string& id : measuresOf(task_)) {
    const auto value = measures_.value(id);
    if (!value) continue;
    const auto known = std::ranges::find(ruleMeasures(), id, &RuleMeasure::id);
    line += fmt::format("{}{} {:.1f}{}{}", line.empty() ? "" : " · ", id, *value, known->unit.empty() ? "" : " ",
                        known->unit);
  }
  return line;
}

}  // namespace app
