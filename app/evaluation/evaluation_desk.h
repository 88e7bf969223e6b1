// The tasks of an evaluation during a rehearsal: follows every tick with the command in force, lets the rules fire,
// begins and ends tasks, takes what the evaluator or the script says, and tells the surgeon the task. It changes
// nothing that is felt but the instrument that a task begins with. Rules that need the bone of a tick are looked at
// once it is told: they fire with the tick that they are of, and the task ends when that is known. Main thread, once a
// frame; the cost of task_watch.
#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/controls/control.h"
#include "app/evaluation/bone_source.h"
#include "app/evaluation/evaluation_course.h"
#include "app/evaluation/session_people.h"
#include "haptics/servo/command.h"
#include "haptics/servo/tick.h"

namespace app {

/// Kind of the events of a recording with its marks.
inline constexpr char kEvaluationEvent[] = "evaluation";

class EvaluationDesk {
 public:
  struct Parts {
    const StudyTemplate& study;
    EvaluationCourse& course;
    SessionPeople& people;
    std::function<std::int64_t()> clock_ns;  ///< none where the ticks are the clock (fast)
    std::int64_t begun_ns = 0;               ///< of the log, at the first tick: where the ticks are the clock
    BoneSource* bone = nullptr;              ///< for rules that need it; null: what they name has no value
    std::function<void(const Moment&)> each_frame = {};             ///< once the ticks of a frame are followed
    std::function<std::string(std::int64_t now_ns)> reminder = {};  ///< to be shown before the task; empty: nothing
  };
  /// Borrows all. The next task begins by itself where the people lead so, else when the evaluator says so.
  explicit EvaluationDesk(Parts parts);

  /// Once the case is there, with the study's tools as the tray: the structures that the bur keeps off, borrowed, and
  /// the file of the recording, empty where there is none.
  void open(const assets::RiskStructures& structures, const std::string& recording);
  /// All ticks, in order; `command` in force now, with the number that ticks tell of it.
  void follow(std::span<const haptics::Tick> ticks, const haptics::Command& command, std::uint64_t serial);

  /// Instruments to put into the hand since the last call.
  std::vector<ControlRequest> takeRequests();
  /// For the sealed recording since the last call: what happened, no words: "task.start trough", "note 12".
  std::vector<std::string> takeMarks();
  bool allowsPictures() const { return parts_.course.allows("picture"); }
  /// Whether the template lets this be changed now; the change, or the refusal, is logged.
  bool allows(const ControlRequest& request);

  std::string toSurgeon() const;
  std::string toEvaluator() const;
  bool isOver() const;
  /// The rehearsal has ended.
  void finish();
  /// Of the newest tick.
  Moment now() const;
  /// Of the task that goes on, without its pauses; 0 between two.
  double task_s() const { return watched_ == nullptr ? 0.0 : task_s_; }
  /// Of a measure that its rules name; none: not known yet, or no task goes on.
  std::optional<double> measure(std::string_view id) const;

 private:
  struct Numbered {
    std::uint64_t serial = 0;
    haptics::Command command;
  };
  /// A tick of the running task whose bone is not told yet.
  struct Unlooked {
    haptics::Tick tick;
    haptics::Command in_force;
  };
  const haptics::Command& commandOf(const haptics::Tick& tick) const;
  void begin();
  void tellEnd();
  void say(Said said);
  void takeSaid();
  bool isKnown(const haptics::Tick& tick) const;
  void lookAtRules();
  void tellBoneNews();
  std::string reminded() const;

  Parts parts_;
  const assets::RiskStructures* structures_ = nullptr;
  std::vector<std::string> tray_;
  std::vector<Numbered> commands_;
  std::optional<TaskWatch> watch_;
  std::deque<Unlooked> unlooked_;
  std::optional<std::uint64_t> looked_;  ///< newest tick of the task whose rules were looked at
  const TaskTemplate* watched_ = nullptr;
  std::uint64_t next_tick_ = 0;
  double now_s_ = 0.0, dt_s_ = 0.0, task_s_ = 0.0;
  std::vector<ControlRequest> requests_;
  std::vector<std::string> marks_;
  std::size_t said_ = 0;
};

}  // namespace app
