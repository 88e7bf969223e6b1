#include "app/evaluation/rule_check.h"

#include <algorithm>
#include <memory>
#include <optional>

#include <fmt/core.h>

#include "app/evaluation/seat/follower.h"
#include "app/evaluation/task_watch.h"
#include "app/session/session_reader.h"
#include "app/station/session_patient.h"
#include "app/station/session_risks.h"

namespace app {
namespace {

/// A task as the log tells it: from its first tick to the last that was looked at.
struct Told {
  const TaskTemplate* task = nullptr;
  std::uint64_t start = 0;
  std::optional<std::uint64_t> stop, looked_end;
  std::vector<RuleFired> fired, again;
  std::unique_ptr<TaskWatch> watch;
  /// After the first of each, until the second: it stood still.
  std::vector<std::pair<std::uint64_t, std::optional<std::uint64_t>>> pauses;

  bool stoodStill(std::uint64_t tick) const {
    return std::ranges::any_of(
        pauses, [&](const auto& one) { return tick > one.first && (!one.second || tick < *one.second); });
  }
};

std::vector<Told> toldIn(const StudyTemplate& study, const std::vector<LogEvent>& events) {
  std::vector<Told> told;
  for (const LogEvent& event : events) {
    const std::string* const id = event.text("task");
    if (event.type == "task.start" && id != nullptr && event.tick) {
      const auto place = study.taskNamed(*id);
      if (place) told.push_back({&study.tasks[*place], *event.tick, {}, {}, {}, {}, {}, {}});
    }
    if (told.empty()) continue;
    if (event.type == "task.stop") told.back().stop = event.tick;
    if (event.type == "task.pause" && event.tick) told.back().pauses.push_back({*event.tick, {}});
    if (event.type == "task.resume" && event.tick && !told.back().pauses.empty())
      told.back().pauses.back().second = event.tick;
    // Where bone was waited for, they were looked at until then.
    if (event.type == "rules.looked" && id != nullptr) {
      const auto of = std::find_if(told.rbegin(), told.rend(), [&](const Told& one) { return one.task->id == *id; });
      if (of != told.rend())
        of->looked_end = static_cast<std::uint64_t>(std::max(-1.0, event.number("until").value_or(-1.0)) + 1.0);
    }
    if (event.type != "rule" || !event.tick) continue;
    const std::string* const verdict = event.text("verdict");
    const auto found = std::ranges::find(kRuleVerdicts, verdict == nullptr ? std::string_view() : *verdict);
    if (found == kRuleVerdicts.end()) continue;
    told.back().fired.push_back({static_cast<RuleVerdict>(found - kRuleVerdicts.begin()),
                                 static_cast<std::uint64_t>(event.number("rule_tick").value_or(0.0)), *event.tick,
                                 event.number("time_s").value_or(0.0)});
  }
  return told;
}

}  // namespace

RuleCheck checkRules(const StudyTemplate& study, const std::vector<LogEvent>& events, const std::string& recording) {
  SessionReader session(recording);
  const StoredStart start = session.start();
  const assets::RiskStructures risks = risksOfSession(start, patientWithinSession(start));
  const std::vector<SessionCommand> commands = session.commands();
  std::vector<Told> told = toldIn(study, events);
  for (Told& one : told) one.watch = std::make_unique<TaskWatch>(*one.task, risks);

  std::optional<Follower> follower;
  if (std::vector<std::string> ids = boneMeasuresOf(study); !ids.empty()) follower.emplace(start, std::move(ids));
  if (follower) follower->add(commands);
  const auto bone = [&](std::string_view id) -> std::optional<double> {
    const auto found = std::ranges::find(follower->measures().ids(), id);
    return follower->measures().values()[static_cast<std::size_t>(found - follower->measures().ids().begin())];
  };
  haptics::Command in_force;
  auto next = commands.begin();
  for (TickBlock block = session.nextBlock(); !block.ticks.empty(); block = session.nextBlock())
    for (const haptics::Tick& tick : block.ticks) {
      for (; next != commands.end() && next->first_tick <= tick.index; ++next) in_force = next->command;
      if (follower) follower->step(tick);
      for (Told& one : told)
        if (tick.index >= one.start && (!one.stop || tick.index <= *one.stop) &&
            (!one.looked_end || tick.index < *one.looked_end) && !one.stoodStill(tick.index))
          if (const auto fired = one.watch->add(tick, in_force, follower ? BoneValue(bone) : BoneValue()))
            one.again.push_back(*fired);
    }

  RuleCheck check;
  for (const Told& one : told) {
    check.fired += one.fired.size();
    if (one.fired == one.again) continue;
    const auto ticks = [](const std::vector<RuleFired>& fired) {
      std::string words;
      for (const RuleFired& rule : fired) words += fmt::format("{}{}", words.empty() ? "" : ", ", rule.tick);
      return words.empty() ? std::string("none") : words;
    };
    check.deviate.push_back(fmt::format("{}: rules fired live at tick {}, in the recording at {}", one.task->id,
                                        ticks(one.fired), ticks(one.again)));
  }
  return check;
}

}  // namespace app
