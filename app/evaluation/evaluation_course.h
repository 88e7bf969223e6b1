// The course of one evaluation session: prepare, consent by stream, warm-up, tasks in their order, debrief,
// questionnaires, close. Takes what people and rules say, keeps each phase until it is done, and writes the one event
// log. Time is passed in, from one clock; ticks where the servo runs. Pure but for the sink; one thread, microseconds.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/evaluation/study_template.h"
#include "app/evaluation/task_watch.h"
#include "app/study/session_log.h"
#include "app/study/study_data.h"

namespace app {

enum class Phase : std::uint8_t { prepare, consent, warm_up, tasks, debrief, questionnaires, close, ended };
inline constexpr std::array<std::string_view, 8> kPhases{"prepare", "consent",        "warm-up", "tasks",
                                                         "debrief", "questionnaires", "close",   "ended"};

inline constexpr std::array<std::string_view, 3> kTaskResults{"success", "partly", "failed"};

/// As a person, a rule or the station says it. Without a time: of now.
struct Moment {
  std::int64_t t_ns = 0;
  std::optional<std::uint64_t> tick;
};

enum class CheckLight : std::uint8_t { green, amber, red };
struct Check {
  std::string name;
  CheckLight light = CheckLight::green;
  std::string words;
};

struct Participant {
  std::string code, group;
  int visit = 1;
  std::string evaluator;  ///< code, who rates the problems
};

/// How a task went.
struct TaskOutcome {
  std::size_t task = 0;  ///< place in the template
  std::uint64_t start_tick = 0;
  std::optional<TaskResult> result;  ///< none: it goes on
  std::string by, reason;            ///< rule, evaluator, end
  double time_s = 0.0;
  int helps = 0;
  std::optional<RuleFired> rule;  ///< its own verdict, also where a person decided otherwise
};

class EvaluationCourse {
 public:
  using Sink = std::function<void(const LogEvent&)>;

  /// Borrows the template. The sink receives each event once, in order.
  EvaluationCourse(const StudyTemplate& study, const Participant& participant, Sink sink);

  Phase phase() const { return phase_; }
  const std::vector<std::size_t>& order() const { return order_; }

  /// Logs them. False: one is red, the session has ended.
  bool prepare(const std::vector<Check>& checks, const Moment& at);
  /// Begins a phase that stands after this one; what lies between is left out. Ends the tasks.
  void enter(Phase phase, const Moment& at);

  /// An event of evaluator or participant: consent {stream, given}; note {kind, text, severity}; prompt {prompt};
  /// bookmark {label}; help {reason}; problem {problem, title, severity}; task {result, reason}, {result: "next"} or
  /// {result: "pause"}, which holds the task and lets it go on in turn; change {what}; answer {questionnaire, item,
  /// value or words}; submit {questionnaire}. Returns why it is not accepted, or nothing.
  std::optional<std::string> take(LogEvent event);

  /// A stream was allowed, by the newest word on it.
  bool allows(std::string_view stream) const;
  /// Each stream has a yes or no.
  bool isConsentComplete() const { return consent_.size() == kConsentStreams.size(); }

  /// In the phase of tasks: the next one is begun. Null: all are done, or one goes on.
  const TaskTemplate* startTask(const Moment& at);
  /// The running one; null: none.
  const TaskTemplate* running() const;
  void fired(const RuleFired& rule, const Moment& at);
  bool isTimeBoxOver() const { return is_box_over_; }
  /// The running task stands still: its clock, its time box and its rules.
  bool isPaused() const { return paused_ns_.has_value(); }
  const Participant& participant() const { return participant_; }
  /// The newest word on a stream; none yet.
  std::optional<bool> wordOn(std::string_view stream) const;
  bool isLocked(std::string_view questionnaire) const { return locked_.contains(questionnaire); }
  bool areTasksDone() const { return outcomes_.size() == order_.size() && running() == nullptr; }
  const std::vector<TaskOutcome>& outcomes() const { return outcomes_; }
  /// The rehearsal has ended while the task went on.
  void endOfRehearsal(const Moment& at);

  /// Any other event of the station.
  void log(const Moment& at, std::string_view source, std::string_view type,
           std::vector<std::pair<std::string, LogValue>> data = {});

 private:
  void finishTask(TaskResult result, std::string_view by, const std::string& reason, const Moment& at);
  std::optional<std::string> takeConsent(const LogEvent& event);
  std::optional<std::string> takeTask(const LogEvent& event);
  std::optional<std::string> takePause(const LogEvent& event);
  std::optional<std::string> takeAnswer(const LogEvent& event);
  std::optional<std::string> takeSubmit(const LogEvent& event);
  std::optional<std::string> takeNote(LogEvent& event);
  const AskedQuestionnaire* asked(const LogEvent& event) const;

  const StudyTemplate& study_;
  Participant participant_;
  Sink sink_;
  Phase phase_ = Phase::prepare;
  std::vector<std::size_t> order_;
  std::map<std::string, bool, std::less<>> consent_, locked_;
  std::vector<TaskOutcome> outcomes_;
  std::int64_t task_began_ns_ = 0;         ///< moved on by pauses
  std::optional<std::int64_t> paused_ns_;  ///< since then
  bool is_box_over_ = false;
};

}  // namespace app
