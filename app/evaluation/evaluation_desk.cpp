#include "app/evaluation/evaluation_desk.h"

#include <algorithm>
#include <utility>

#include <fmt/core.h>

#include "app/text/clock_text.h"
#include "app/text/message.h"

namespace app {
namespace {

/// For what a second servo says: of all ticks where they are the clock, of the last ones at the end.
constexpr std::chrono::minutes kLongestWait{10};
constexpr std::chrono::milliseconds kLastWait{2000};

}  // namespace

EvaluationDesk::EvaluationDesk(Parts parts) : parts_(std::move(parts)), tray_(parts_.study.tools()) {}

void EvaluationDesk::open(const assets::RiskStructures& structures, const std::string& recording) {
  structures_ = &structures;
  if (parts_.bone != nullptr) parts_.bone->start(recording);
}

Moment EvaluationDesk::now() const {
  constexpr double kSecond_ns = 1e9;
  const auto ticks_ns = parts_.begun_ns + static_cast<std::int64_t>(now_s_ * kSecond_ns + 0.5);
  const std::optional<std::uint64_t> newest = next_tick_ > 0 ? std::optional(next_tick_ - 1) : std::nullopt;
  return {parts_.clock_ns ? parts_.clock_ns() : ticks_ns, newest};
}

/// The newest that this tick was made with.
const haptics::Command& EvaluationDesk::commandOf(const haptics::Tick& tick) const {
  std::size_t at = commands_.size() - 1;
  while (at > 0 && commands_[at].serial > tick.command_serial) --at;
  return commands_[at].command;
}

void EvaluationDesk::tellEnd() {
  if (watched_ == nullptr) return;
  const std::vector<TaskOutcome>& outcomes = parts_.course.outcomes();
  const auto ended = std::find_if(outcomes.rbegin(), outcomes.rend(), [this](const TaskOutcome& one) {
    return one.result && &parts_.study.tasks[one.task] == watched_;
  });
  if (ended == outcomes.rend()) return;
  const std::string_view result = kTaskResults[static_cast<std::size_t>(*ended->result)];
  marks_.push_back(fmt::format("task.stop {} {}", watched_->id, result));
  printMessage(fmt::format("{}: {} after {}, by {}", watched_->id, result, clockText(ended->time_s), ended->by));
}

/// The next task, if it is time: with the tick that comes.
void EvaluationDesk::begin() {
  const TaskTemplate* const running = parts_.course.running();
  if (running == watched_) return;
  tellEnd();
  // What the rules were not asked for any more, as a person decided first.
  if (watched_ != nullptr && parts_.bone != nullptr)
    parts_.course.log(now(), "system", "rules.looked",
                      {{"task", watched_->id}, {"until", looked_ ? static_cast<std::int64_t>(*looked_) : -1}});
  watched_ = running;
  watch_.reset();
  unlooked_.clear();
  looked_.reset();
  if (running == nullptr) return;
  watch_.emplace(*running, *structures_);
  task_s_ = 0.0;
  marks_.push_back("task.start " + running->id);
  printMessage(fmt::format("task {} of {}, {}: {}", parts_.course.outcomes().size(), parts_.course.order().size(),
                           running->id, running->say));
  const auto tool = std::ranges::find(tray_, running->tool);
  if (tool != tray_.end()) requests_.push_back({Control::tool, static_cast<int>(tool - tray_.begin())});
}

void EvaluationDesk::say(Said said) {
  LogEvent& event = said.event;
  const Moment at = now();
  // A decision counts when it is made, a note from its first letter on.
  if (event.t_ns == 0 || event.type == "task") event.t_ns = at.t_ns;
  event.tick = at.tick;
  if (constexpr double kSecond_ns = 1e9; event.tick && dt_s_ > 0.0 && event.t_ns < at.t_ns) {
    const double ago = static_cast<double>(at.t_ns - event.t_ns) / kSecond_ns / dt_s_;
    event.tick = ago < static_cast<double>(*event.tick) ? *event.tick - static_cast<std::uint64_t>(ago) : 0;
  }
  // A task that is begun by hand, or goes on, does so with the next tick.
  const std::string result = event.textOr("result");
  if (result == "next" || (result == "pause" && parts_.course.isPaused())) event.tick = next_tick_;
  const std::string type = event.type;
  const auto refused = parts_.course.take(std::move(event));
  if (refused) {
    parts_.course.log(at, "system", "refused", {{"what", type}, {"why", *refused}});
    printMessage((said.where.empty() ? type : said.where) + ": " + *refused);
  } else {
    marks_.push_back(fmt::format("{} {}", type, ++said_));
  }
  if (said.answered) said.answered(refused);
}

void EvaluationDesk::takeSaid() {
  for (Said& one : parts_.people.take(watched_ != nullptr ? watched_->id : "", task_s())) say(std::move(one));
}

void EvaluationDesk::follow(std::span<const haptics::Tick> ticks, const haptics::Command& command,
                            std::uint64_t serial) {
  if (commands_.empty() || commands_.back().serial != serial) commands_.push_back({serial, command});
  // Where the ticks are the clock, all that is to be told of them is told first.
  if (parts_.bone != nullptr && !ticks.empty())
    parts_.bone->update(ticks.back().index, parts_.clock_ns ? std::chrono::milliseconds(0) : kLongestWait);
  for (const haptics::Tick& tick : ticks) {
    if (parts_.people.leads() && parts_.course.running() == nullptr) parts_.course.startTask({now().t_ns, tick.index});
    begin();
    next_tick_ = tick.index + 1;
    now_s_ = tick.t_s + tick.dt_s;
    dt_s_ = tick.dt_s;
    // While it is paused neither its clock nor its rules go on.
    if (watch_ && !parts_.course.isPaused()) {
      unlooked_.push_back({tick, commandOf(tick)});
      task_s_ += tick.dt_s;
    }
    lookAtRules();
    // A script says it at its tick.
    if (!parts_.clock_ns) takeSaid();
  }
  lookAtRules();
  if (parts_.clock_ns) takeSaid();
  begin();
  tellBoneNews();
  if (parts_.each_frame) parts_.each_frame(now());
  // Ticks of one command are enough of it.
  constexpr std::size_t kMostCommands = 64;
  if (commands_.size() > kMostCommands) commands_.erase(commands_.begin());
}

bool EvaluationDesk::isKnown(const haptics::Tick& tick) const {
  return parts_.bone == nullptr || parts_.bone->isLost() || tick.index < parts_.bone->followed();
}

void EvaluationDesk::lookAtRules() {
  while (watch_ && parts_.course.running() == watched_ && !unlooked_.empty() && isKnown(unlooked_.front().tick)) {
    const Unlooked one = unlooked_.front();
    unlooked_.pop_front();
    looked_ = one.tick.index;
    const auto bone = [&](std::string_view id) -> std::optional<double> {
      return parts_.bone == nullptr || one.tick.index >= parts_.bone->followed()
                 ? std::nullopt
                 : parts_.bone->value(id, one.tick.index);
    };
    const auto fired = watch_->add(one.tick, one.in_force, bone);
    if (!fired) continue;
    marks_.push_back(fmt::format("rule {} {} {}", watched_->id, kRuleVerdicts[static_cast<std::size_t>(fired->verdict)],
                                 fired->tick));
    parts_.course.fired(*fired, now());
  }
}

void EvaluationDesk::tellBoneNews() {
  if (parts_.bone == nullptr) return;
  for (BoneSource::News& news : parts_.bone->takeNews()) {
    printMessage(news.type + (news.data.empty() ? "" : ", see the event log"));
    parts_.course.log(now(), "system", news.type, std::move(news.data));
  }
}

std::vector<ControlRequest> EvaluationDesk::takeRequests() { return std::exchange(requests_, {}); }

std::vector<std::string> EvaluationDesk::takeMarks() { return std::exchange(marks_, {}); }

bool EvaluationDesk::allows(const ControlRequest& request) {
  const bool is_law = request.control == Control::law;
  const bool is_layer = request.control == Control::layer || request.control == Control::face;
  const bool is_picture = request.control == Control::snapshot;
  if (!is_law && !is_layer && !is_picture) return true;
  const bool may = is_law     ? parts_.study.law_may_change
                   : is_layer ? parts_.study.layers_may_change
                              : parts_.course.allows("picture");
  const std::string what(meaningOf(request.control).name);
  parts_.course.log(now(), "evaluator", may ? "change" : "change.refused",
                    {{"what", what}, {"value", static_cast<std::int64_t>(request.value)}});
  return may;
}

std::string EvaluationDesk::toSurgeon() const {
  if (const std::string reminder = reminded(); !reminder.empty()) return reminder;
  if (watched_ != nullptr) return watched_->say;
  return parts_.course.areTasksDone() ? "all tasks are done" : "the next task will be told";
}

std::string EvaluationDesk::reminded() const { return parts_.reminder ? parts_.reminder(now().t_ns) : ""; }

std::string EvaluationDesk::toEvaluator() const {
  if (const std::string reminder = reminded(); !reminder.empty()) return reminder;
  const std::size_t place = parts_.course.outcomes().size(), all = parts_.course.order().size();
  if (watched_ == nullptr) return fmt::format("{} of {} tasks done: 5 5 begins the next", place, all);
  const std::string measures = watch_ ? watch_->line() : "";
  return fmt::format("{} ({}/{}) {} of {}{}{}{}", watched_->id, place, all, clockText(task_s_),
                     clockText(watched_->time_box_s),
                     parts_.course.isPaused()        ? ", paused: 5 4 goes on"
                     : parts_.course.isTimeBoxOver() ? ", time is over: decide"
                                                     : "",
                     measures.empty() ? "" : " · ", measures);
}

std::optional<double> EvaluationDesk::measure(std::string_view id) const {
  return watch_ ? watch_->measure(id) : std::nullopt;
}

bool EvaluationDesk::isOver() const {
  return (parts_.course.areTasksDone() && parts_.people.mayEndTasks()) ||
         (parts_.course.isConsentComplete() && !parts_.course.allows("log"));
}

void EvaluationDesk::finish() {
  if (parts_.bone != nullptr && !unlooked_.empty()) {
    parts_.bone->update(unlooked_.back().tick.index, parts_.clock_ns ? kLastWait : kLongestWait);
    lookAtRules();
    begin();
  }
  parts_.course.endOfRehearsal(now());
  begin();
  tellBoneNews();
}

}  // namespace app
