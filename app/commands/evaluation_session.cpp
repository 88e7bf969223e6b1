#include "app/commands/evaluation_session.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "app/commands/compose_rehearsal.h"
#include "app/commands/evaluation_checks.h"
#include "app/debrief/bookmarks.h"
#include "app/evaluation/evaluation_desk.h"
#include "app/evaluation/evaluator_terminal.h"
#include "app/evaluation/participant_terminal.h"
#include "app/evaluation/rule_check.h"
#include "app/evaluation/script.h"
#include "app/evaluation/seat/seat_link.h"
#include "app/evaluation/session_tables.h"
#include "app/rehearsal/rehearsal.h"
#include "app/session/input_feed.h"
#include "app/session/replay.h"
#include "app/study/study_folder.h"
#include "app/text/anonymous_id.h"
#include "app/text/list.h"
#include "app/text/message.h"
#include "app/text/usage_error.h"
#include "assets/toml_reader.h"
#include "calibration/output_file.h"
#include "calibration/record/sha256.h"
#include "haptics/device/device_catalogue.h"

namespace app {
namespace {

namespace fs = std::filesystem;

constexpr double kForever_s = std::numeric_limits<double>::infinity();
constexpr double kSecond_ns = 1e9;

/// The warm-up's: a block at the same place with the same hand; nothing of it is recorded.
RehearseOptions warmUpOptions(const RehearseOptions& main, const StudyTemplate& study) {
  RehearseOptions warm;
  warm.case_name = study.warm_up_block;
  warm.no_record = true;
  warm.rig = main.rig, warm.pedal = main.pedal, warm.falcon_firmware = main.falcon_firmware;
  warm.shaft = main.shaft, warm.law = main.law, warm.erosion = main.erosion, warm.size = main.size;
  warm.pace = main.pace, warm.picture = main.picture, warm.settings = main.settings, warm.display = main.display;
  warm.position = main.position, warm.monitor = main.monitor, warm.loupes = main.loupes;
  warm.no_line = main.no_line, warm.no_sound = main.no_sound;
  warm.plan.device = main.plan.device, warm.plan.device_options = main.plan.device_options;
  warm.plan.headless = main.plan.headless, warm.plan.instructor_window = main.plan.instructor_window;
  warm.plan.rate_Hz = main.plan.rate_Hz, warm.plan.parameters = main.plan.parameters;
  warm.plan.seconds = study.warm_up_s;
  warm.plan.summary = false;
  return warm;
}

void refuseUnlessFits(const EvaluateOptions& options, const StudyTemplate& study) {
  const RehearseOptions& rehearsal = options.rehearsal;
  static const RehearseOptions kUntouched;
  if (!isAnonymousId(options.participant)) throw UsageError("--participant: give a code as P07, never a name");
  if (!isAnonymousId(options.evaluator)) throw UsageError("--evaluator: give a code as E1, never a name");
  if (!rehearsal.record.empty() || rehearsal.no_record)
    throw UsageError("evaluate: a session is recorded into --out, leave --record and --no-record out");
  if (!rehearsal.continued.empty())
    throw UsageError("--continue " + rehearsal.continued + ": every participant begins alike, leave it out");
  if (!study.case_name.empty() && (!rehearsal.patient.empty() || !rehearsal.case_name.empty()))
    throw UsageError("evaluate: " + options.study_template + " names the case " + study.case_name +
                     ", leave PATIENT and --case out");
  if (!study.tools().empty() && rehearsal.tools != kUntouched.tools)
    throw UsageError("--tool: " + options.study_template + " names the tasks' tools, leave it out");
  std::vector<std::string> groups;
  for (const AskedQuestionnaire& asked : study.questionnaires)
    for (const std::string& group : asked.groups)
      if (std::ranges::find(groups, group) == groups.end()) groups.push_back(group);
  if (!groups.empty() && std::ranges::find(groups, options.group) == groups.end())
    throw UsageError("--group " + options.group + ": give one of " + joined(groups));
  if (options.script.empty() && !isTerminalThere())
    throw UsageError("evaluate: consent and questions are asked at a terminal, run it in one or give --script");
}

/// One session, phase by phase.
class EvaluationSession {
 public:
  EvaluationSession(EvaluateOptions& options)
      : options_(options),
        template_text_(assets::readSmallFile(options.study_template)),
        study_(studyTemplateFrom(template_text_, options.study_template)),
        consent_text_(assets::readSmallFile(
            (fs::path(options.study_template).parent_path() / study_.consent_file).string(), kMostConsent,
            "it is the consent of " + options.study_template + ", write it beside that")),
        steps_(options.rehearsal.pace == "fast") {
    refuseUnlessFits(options, study_);
    if (!options.script.empty()) script_ = evaluationScriptOf(options.script, study_, options.participant);
    if (fs::exists(options.out))
      place_ = nextSession(sessionsIn(options.out), options.participant);
    else
      place_ = nextSession({}, options.participant);
    course_.emplace(study_, Participant{options.participant, options.group, place_.visit, options.evaluator},
                    [this](const LogEvent& event) { keep(event); });
  }

  int run() {
    RehearseOptions warm = warmUpOptions(options_.rehearsal, study_);
    if (!study_.case_name.empty()) options_.rehearsal.case_name = study_.case_name;
    if (!study_.tools().empty()) options_.rehearsal.tools = study_.tools();
    std::optional<RehearsalPlan> plan = composeRehearsal(options_.rehearsal);
    if (!plan) return 0;
    // Nobody looks into them while questions are asked; each rehearsal opens its own.
    plan->windows.reset();
    if (!prepare(*plan)) return 1;
    if (!askConsent()) return 1;
    if (!study_.warm_up_block.empty() && !warmUp(warm, *plan)) return interrupted();
    const int recorded = doTasks(std::move(*plan));
    if (wasInterrupted()) return interrupted();
    if (!course_->allows("log")) {
      printMessage("the log is not allowed any more: the session ends; what was kept until then lies in " + folder());
      return 1;
    }
    saveBookmarks();
    askAll(Phase::debrief);
    askAll(Phase::questionnaires);
    return std::max(recorded, close());
  }

 private:
  static constexpr std::size_t kMostConsent = 64U * 1024U;

  std::int64_t now_ns() const {
    return steps_ ? virtual_ns_ : std::chrono::steady_clock::now().time_since_epoch().count();
  }
  Moment now() const { return {now_ns(), {}}; }
  std::string folder() const { return (fs::path(options_.out) / place_.folder).string(); }
  std::string recording() const { return (fs::path(folder()) / "session.molar").string(); }

  /// In memory until the log is allowed.
  void keep(const LogEvent& event) {
    events_.push_back(event);
    if (!log_) return;
    log_->add(event);
    if (const auto trouble = log_->trouble(); trouble && !std::exchange(has_told_trouble_, true))
      printMessage(*trouble);
  }

  bool prepare(const RehearsalPlan& plan) {
    const std::vector<Check> checks = evaluationChecks(plan, options_.out);
    for (const Check& check : checks)
      if (check.light != CheckLight::green)
        printMessage(fmt::format("{}: {} ({})", check.name, check.words,
                                 check.light == CheckLight::red ? "red: not begun" : "amber"));
    if (!course_->prepare(checks, now())) return false;
    course_->log(now(), "system", "template",
                 {{"title", study_.title}, {"sha256", calibration::sha256Of(template_text_)}});
    return true;
  }

  void takeScripted(std::string_view during) {
    for (ScriptedEvent& one : script_.takeDue(during, kForever_s)) {
      if (steps_)
        virtual_ns_ = std::max(virtual_ns_, phase_began_ns_ + static_cast<std::int64_t>(one.at_s * kSecond_ns));
      one.event.t_ns = now_ns();
      if (const auto refused = course_->take(one.event)) throw UsageError(one.where + ": " + *refused);
    }
  }
  void enter(Phase phase) {
    course_->enter(phase, now());
    phase_began_ns_ = now_ns();
    printMessage(std::string(kPhases[static_cast<std::size_t>(phase)]));
  }

  bool askConsent() {
    enter(Phase::consent);
    course_->log(now(), "system", "consent.text",
                 {{"language", study_.language}, {"sha256", calibration::sha256Of(consent_text_)}});
    if (options_.script.empty()) askConsentAtTerminal(*course_, consent_text_, [this] { return now_ns(); });
    takeScripted("consent");
    if (!course_->isConsentComplete())
      throw UsageError((options_.script.empty() ? "consent" : options_.script) +
                       ": each stream needs a yes or no before the session: " + joined(kConsentStreams));
    if (!course_->allows("log")) {
      printMessage("the participant allows no log: the session ends, and nothing of it is kept");
      return false;
    }
    openFolder();
    return true;
  }

  void openFolder() {
    std::error_code failed;
    fs::create_directories(options_.out, failed);
    if (failed || !fs::create_directory(folder(), failed))
      throw UsageError("--out " + options_.out + ": " + place_.folder + " cannot be made there, give another folder");
    fs::permissions(folder(), fs::perms::owner_all, failed);
    log_.emplace((fs::path(folder()) / kSessionLogName).string());
    for (const LogEvent& event : events_) log_->add(event);
    // Byte for byte, as the session was made with it.
    calibration::OutputFile((fs::path(folder()) / "template.toml").string(), false).commit(template_text_);
  }

  bool warmUp(RehearseOptions& warm, RehearsalPlan& plan) {
    enter(Phase::warm_up);
    takeScripted("warm-up");
    // One device: lent to the block, and opened again after it.
    warm.plan.opened = std::move(plan.opened);
    plan.opened.reset();
    std::optional<RehearsalPlan> block = composeRehearsal(warm);
    if (!block) return false;
    block->instruction = "warm-up: try the hand, and say aloud what you think";
    if (rehearse(std::move(*block)) != 0 || wasInterrupted()) return false;
    if (steps_) virtual_ns_ += static_cast<std::int64_t>(study_.warm_up_s * kSecond_ns);
    if (haptics::isDeviceAddress(plan.device)) plan.opened = haptics::openDevice(plan.device, plan.device_options);
    return true;
  }

  int doTasks(RehearsalPlan plan) {
    enter(Phase::tasks);
    plan.recording->path = recording();
    plan.recording->by_default = false;
    if (!course_->allows("picture")) plan.snapshot.clear(), plan.first_snapshot.clear();
    rate_Hz_ = plan.rate_Hz.value_or(rate_Hz_);
    std::optional<EvaluatorTerminal> terminal;
    if (!steps_ && isTerminalThere()) {
      std::vector<std::string> prompts;
      for (const PromptTemplate& prompt : study_.prompts) prompts.push_back(prompt.id);
      terminal.emplace(std::move(prompts));
      printMessage(std::string(kEvaluatorKeys));
    }
    EvaluationDesk::Parts parts{study_, *course_, script_, {}, {}, now_ns()};
    if (terminal) parts.evaluator = [&] { return terminal->take(now_ns()); };
    if (!steps_) parts.clock_ns = [this] { return now_ns(); };
    std::optional<InputFeed> feed;
    std::optional<SeatLink> seat;
    if (std::vector<std::string> ids = boneMeasuresOf(study_); !ids.empty()) {
      plan.recording->tap = &feed.emplace();
      parts.bone = &seat.emplace(*feed, std::move(ids));
    }
    EvaluationDesk desk(std::move(parts), !options_.script.empty());
    plan.evaluation = &desk;
    const int status = rehearse(std::move(plan));
    virtual_ns_ = std::max(virtual_ns_, desk.now().t_ns);
    // Where the ticks are the clock, two runs give the same log.
    if (seat && !steps_) logSeat(*seat);
    if (status != 0) course_->log(now(), "system", "recording.trouble", {});
    writeTables();
    return status;
  }

  void logSeat(const SeatLink& seat) {
    const SeatLink::Figures figures = seat.figures();
    course_->log(now(), "system", "seat",
                 {{"followed", static_cast<std::int64_t>(seat.followed())},
                  {"lag_p50_ticks", static_cast<std::int64_t>(figures.lag_p50_ticks)},
                  {"lag_p99_ticks", static_cast<std::int64_t>(figures.lag_p99_ticks)},
                  {"processor_s", figures.processor_s},
                  {"starts", std::int64_t{figures.starts}},
                  {"taken_over", std::int64_t{figures.taken_over}}});
  }

  /// Those of words in the debrief, the others after it.
  void askAll(Phase phase) {
    enter(phase);
    if (phase == Phase::debrief) printMessage("to look at moments: molar debrief " + recording());
    takeScripted(kPhases[static_cast<std::size_t>(phase)]);
    if (options_.script.empty())
      for (const AskedQuestionnaire* asked : study_.questionnairesFor(options_.group))
        if (asked->questionnaire.isOfWords() == (phase == Phase::debrief))
          askAtTerminal(*course_, asked->questionnaire, [this] { return now_ns(); });
    writeTables();
  }

  void writeTables() {
    for (const SessionTable& table : sessionTables(study_, events_, place_.folder)) {
      calibration::OutputFile file((fs::path(folder()) / table.name).string(), true);
      file.commit(table.text);
    }
  }

  /// Notes, bookmarks and problems as moments of `molar debrief`.
  void saveBookmarks() {
    Bookmarks bookmarks(Bookmarks::fileFor(recording()));
    for (const LogEvent& event : events_) {
      if (!event.tick || (event.type != "note" && event.type != "bookmark" && event.type != "problem")) continue;
      const char* const key = event.type == "note" ? "text" : event.type == "problem" ? "title" : "label";
      const std::string* const words = event.text(key);
      bookmarks.set(static_cast<double>(*event.tick) / rate_Hz_,
                    event.type + (words != nullptr && !words->empty() ? ": " + *words : std::string()));
    }
    if (!bookmarks.all().empty()) bookmarks.save();
  }

  int interrupted() {
    course_->log(now(), "system", "session.interrupted", {});
    printMessage(folder() + ": interrupted; the same participant again begins the session anew");
    return 1;
  }

  int close() {
    enter(Phase::close);
    takeScripted("close");
    for (const ScriptedEvent& one : script_.left()) {
      course_->log(now(), "system", "script.left", {{"where", one.where}});
      printMessage(one.where + ": " + one.during + " had ended before, it was not said");
    }
    const ReplayReport replay = verify(recording());
    const RuleCheck rules = checkRules(study_, events_, recording());
    for (const std::string& line : rules.deviate) printMessage(line);
    printMessage(replay.line());
    course_->log(now(), "system", "verified",
                 {{"recording", replay.verified()},
                  {"rules", static_cast<std::int64_t>(rules.fired)},
                  {"rules_deviate", static_cast<std::int64_t>(rules.deviate.size())}});
    writeTables();
    course_->log(now(), "system", "session.stop",
                 {{"retention_days", static_cast<std::int64_t>(study_.retention_days)}});
    printMessage(folder() + ": done; all of them together: molar study " + options_.out);
    return replay.verified() && rules.deviate.empty() ? 0 : 1;
  }

  EvaluateOptions& options_;
  std::string template_text_;
  StudyTemplate study_;
  std::string consent_text_;
  bool steps_;  ///< the ticks are the clock
  StudySession place_;
  EvaluationScript script_;
  std::optional<EvaluationCourse> course_;
  std::vector<LogEvent> events_;
  std::optional<SessionLogWriter> log_;
  bool has_told_trouble_ = false;
  std::int64_t virtual_ns_ = 0, phase_began_ns_ = 0;
  double rate_Hz_ = 1000.0;
};

}  // namespace

int runEvaluation(EvaluateOptions& options) { return EvaluationSession(options).run(); }

}  // namespace app
