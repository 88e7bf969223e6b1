#include "app/commands/evaluation_session.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "app/commands/compose_rehearsal.h"
#include "app/commands/evaluation_checks.h"
#include "app/commands/evaluation_setup.h"
#include "app/debrief/bookmarks.h"
#include "app/debrief/debrief_plan.h"
#include "app/debrief/log_bookmarks.h"
#include "app/evaluation/console/console.h"
#include "app/evaluation/evaluation_desk.h"
#include "app/evaluation/rule_check.h"
#include "app/evaluation/script_people.h"
#include "app/evaluation/seat/seat_link.h"
#include "app/evaluation/session_book.h"
#include "app/evaluation/terminal_people.h"
#include "app/evaluation/voice/voice_desk.h"
#include "app/rehearsal/rehearsal.h"
#include "app/session/input_feed.h"
#include "app/session/replay.h"
#include "app/text/list.h"
#include "app/text/message.h"
#include "app/text/usage_error.h"
#include "assets/toml_reader.h"
#include "calibration/record/sha256.h"
#include "calibration/record/utc.h"
#include "haptics/device/device_catalogue.h"

namespace app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostConsent = 64U * 1024U;

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
        clock_(options.rehearsal.pace == "fast") {
    refuseUnlessFits(options, study_);
    std::optional<EvaluationScript> script;
    if (!options.script.empty()) script = evaluationScriptOf(options.script, study_, options.participant);
    book_.emplace(options.out, options.participant);
    const Participant participant{options.participant, options.group, book_->place().visit, options.evaluator};
    course_.emplace(study_, participant, [this](const LogEvent& event) { book_->keep(event); });
    voice_.emplace(VoiceDesk::Parts{*course_, microphoneFrom(options.microphone), study_.silence_s, clock_.steps(),
                                    played_.descriptor()});
    if (script)
      people_ = std::make_unique<ScriptPeople>(std::move(*script), *course_, clock_);
    else if (options.page.empty())
      people_ = std::make_unique<TerminalPeople>(
          TerminalPeople::Parts{study_, *course_, clock_, consent_text_, options.group});
    else
      openConsole();
  }

  int run() {
    RehearseOptions warm = warmUpOptions(options_.rehearsal, study_);
    takeCase(options_.rehearsal, study_);
    std::optional<RehearsalPlan> plan = composeRehearsal(options_.rehearsal);
    if (!plan) return 0;
    debrief_ = debriefPlanOf(options_.rehearsal, *plan);
    // Nobody looks into them while questions are asked; each rehearsal opens its own.
    plan->windows.reset();
    if (!prepare(*plan)) return 1;
    if (!askConsent()) return 1;
    if (!study_.warm_up_block.empty() && !warmUp(warm, *plan)) return interrupted();
    const int recorded = doTasks(std::move(*plan));
    if (wasInterrupted()) return interrupted();
    if (!course_->allows("log")) {
      voice_->finish(now());
      printMessage("the log is not allowed any more: the session ends; what was kept until then lies in " +
                   book_->folder());
      return 1;
    }
    saveBookmarks();
    askAll(Phase::debrief);
    askAll(Phase::questionnaires);
    if (wasInterrupted()) return interrupted();
    return std::max(recorded, close());
  }

 private:
  Moment now() const { return {clock_.now_ns(), {}}; }

  void openConsole() {
    auto console = std::make_unique<Console>(
        Console::Parts{study_, *course_, clock_, *book_, consent_text_, [] { return wasInterrupted(); },
                       [this] { voice_->follow(now()); }, [this] { return voice_->state(clock_.now_ns()); },
                       [this] { return voice_->missing(); },
                       [this](DebriefGuide& guide) { return showRecording(guide); }},
        ConsoleAddress{options_.page, options_.share});
    console_ = console.get();
    people_ = std::move(console);
  }

  /// With the day of the calendar; where the ticks are the clock, two runs give the same log.
  std::vector<std::pair<std::string, LogValue>> timed(std::vector<std::pair<std::string, LogValue>> data) const {
    if (!clock_.steps()) data.emplace_back("utc", calibration::nowUtc());
    return data;
  }

  bool prepare(const RehearsalPlan& plan) {
    const std::vector<Check> checks = evaluationChecks(plan, study_, options_.out, voice_->plan());
    for (const Check& check : checks)
      if (check.light != CheckLight::green)
        printMessage(fmt::format("{}: {} ({})", check.name, check.words,
                                 check.light == CheckLight::red ? "red: not begun" : "amber"));
    if (!course_->prepare(checks, now())) return false;
    course_->log(now(), "system", "template",
                 timed({{"title", study_.title}, {"sha256", calibration::sha256Of(template_text_)}}));
    people_->ask(Phase::prepare);
    return !wasInterrupted();
  }

  void enter(Phase phase) {
    course_->enter(phase, now());
    printMessage(std::string(kPhases[static_cast<std::size_t>(phase)]));
  }

  bool askConsent() {
    enter(Phase::consent);
    course_->log(now(), "system", "consent.text",
                 {{"language", study_.language}, {"sha256", calibration::sha256Of(consent_text_)}});
    people_->ask(Phase::consent);
    if (wasInterrupted()) return false;
    if (!course_->isConsentComplete())
      throw UsageError((options_.script.empty() ? "consent" : options_.script) +
                       ": each stream needs a yes or no before the session: " + joined(kConsentStreams));
    if (!course_->allows("log")) {
      printMessage("the participant allows no log: the session ends, and nothing of it is kept");
      return false;
    }
    book_->open(template_text_);
    voice_->begin(book_->folder(), book_->seal(), now());
    return true;
  }

  bool warmUp(RehearseOptions& warm, RehearsalPlan& plan) {
    enter(Phase::warm_up);
    people_->ask(Phase::warm_up);
    // One device: lent to the block, and opened again after it.
    warm.plan.opened = std::move(plan.opened);
    plan.opened.reset();
    std::optional<RehearsalPlan> block = composeRehearsal(warm);
    if (!block) return false;
    block->played = &played_;
    block->instruction = "warm-up: try the hand, and say aloud what you think";
    if (console_ != nullptr) {
      // The evaluator ends it, not before its time is over.
      console_->beginWarmUp(study_.warm_up_s);
      block->spectator = console_;
      block->seconds.reset();
    }
    if (rehearse(std::move(*block)) != 0 || wasInterrupted()) return false;
    constexpr double kSecond_ns = 1e9;
    if (clock_.steps()) clock_.moveTo(clock_.now_ns() + static_cast<std::int64_t>(study_.warm_up_s * kSecond_ns));
    voice_->follow(now());
    if (const std::string missing = voice_->missing(); !missing.empty()) {
      course_->log(now(), "system", "check",
                   {{"name", std::string("voice")}, {"light", std::string("amber")}, {"words", missing}});
      printMessage("voice: " + missing + " (amber)");
    }
    if (haptics::isDeviceAddress(plan.device)) plan.opened = haptics::openDevice(plan.device, plan.device_options);
    return true;
  }

  int doTasks(RehearsalPlan plan) {
    enter(Phase::tasks);
    plan.recording->path = book_->recording();
    plan.recording->by_default = false;
    if (!course_->allows("picture")) plan.snapshot.clear(), plan.first_snapshot.clear();
    rate_Hz_ = plan.rate_Hz.value_or(rate_Hz_);
    people_->ask(Phase::tasks);
    EvaluationDesk::Parts parts{study_, *course_, *people_, {}, clock_.now_ns()};
    if (!clock_.steps()) parts.clock_ns = [this] { return clock_.now_ns(); };
    std::optional<InputFeed> feed;
    std::optional<SeatLink> seat;
    if (std::vector<std::string> ids = boneMeasuresOf(study_); !ids.empty()) {
      plan.recording->tap = &feed.emplace();
      parts.bone = &seat.emplace(*feed, std::move(ids));
    }
    parts.each_frame = [this](const Moment& at) { voice_->follow(at); };
    parts.reminder = [this](std::int64_t at_ns) { return voice_->reminder(at_ns); };
    plan.played = &played_;
    EvaluationDesk desk(std::move(parts));
    plan.evaluation = &desk;
    if (console_ != nullptr) {
      console_->beginTasks(desk, seat ? &*seat : nullptr);
      plan.spectator = console_;
    }
    const int status = rehearse(std::move(plan));
    if (console_ != nullptr) console_->endTasks();
    clock_.moveTo(desk.now().t_ns);
    // Where the ticks are the clock, two runs give the same log.
    if (seat && !clock_.steps()) logSeat(*seat);
    if (status != 0) course_->log(now(), "system", "recording.trouble", {});
    book_->writeTables(study_);
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

  /// In the surgeon's display, steered from the page. Why not, or nothing.
  std::string showRecording(DebriefGuide& guide) {
    debrief_.sessions = {book_->recording()};
    if (book_->isSealed())
      debrief_.voice_opener = [this](std::uint64_t number, std::string_view sealed) -> std::optional<std::string> {
        const SecretKey* const key = book_->seal()->key(SealedStream::audio);
        return key == nullptr ? std::nullopt : openedWith(*key, {book_->place().folder, kVoiceTable, number}, sealed);
      };
    std::string trouble;
    try {
      if (options_.rehearsal.plan.headless)
        followDebriefUnseen(debrief_, guide);
      else
        showDebrief(debrief_, &guide);
    } catch (const std::runtime_error& refusal) {
      trouble = refusal.what();
      course_->log(now(), "system", "debrief.trouble", {{"why", trouble}});
      printMessage(trouble);
    }
    return trouble;
  }

  /// Those of words in the debrief, the others after it.
  void askAll(Phase phase) {
    if (wasInterrupted()) return;
    enter(phase);
    if (phase == Phase::debrief && console_ == nullptr)
      printMessage("to look at moments: molar debrief " + book_->recording());
    people_->ask(phase);
    if (phase == Phase::debrief && console_ != nullptr) saveBookmarks();
    voice_->follow(now());
    book_->writeTables(study_);
  }

  /// Notes, bookmarks and problems as moments of `molar debrief`.
  void saveBookmarks() {
    Bookmarks bookmarks(Bookmarks::fileFor(book_->recording()));
    for (const Bookmark& one : logBookmarks(book_->events(), 1.0 / rate_Hz_, !book_->isSealed()))
      bookmarks.set(one.t_s, one.note);
    if (!bookmarks.all().empty()) bookmarks.save();
  }

  int interrupted() {
    voice_->finish(now());
    course_->log(now(), "system", "session.interrupted", {});
    printMessage(book_->folder() + ": interrupted; the same participant again begins the session anew");
    return 1;
  }

  int close() {
    enter(Phase::close);
    people_->ask(Phase::close);
    for (const Unsaid& one : people_->unsaid()) {
      course_->log(now(), "system", "script.left", {{"where", one.where}});
      printMessage(one.where + ": " + one.during + " had ended before, it was not said");
    }
    voice_->finish(now());
    const ReplayReport replay = verify(book_->recording());
    const RuleCheck rules = checkRules(study_, book_->events(), book_->recording());
    for (const std::string& line : rules.deviate) printMessage(line);
    printMessage(replay.line());
    course_->log(now(), "system", "verified",
                 {{"recording", replay.verified()},
                  {"rules", static_cast<std::int64_t>(rules.fired)},
                  {"rules_deviate", static_cast<std::int64_t>(rules.deviate.size())}});
    book_->writeTables(study_);
    course_->log(now(), "system", "session.stop",
                 timed({{"retention_days", static_cast<std::int64_t>(study_.retention_days)}}));
    if (console_ != nullptr) console_->close(replay.verified(), rules.fired, rules.deviate.size());
    printMessage(book_->folder() + ": done; all of them together: molar study " + options_.out);
    return replay.verified() && rules.deviate.empty() ? 0 : 1;
  }

  EvaluateOptions& options_;
  std::string template_text_;
  StudyTemplate study_;
  std::string consent_text_;
  SessionClock clock_;
  std::optional<SessionBook> book_;
  std::optional<EvaluationCourse> course_;
  PlayedSound played_;
  std::optional<VoiceDesk> voice_;
  std::unique_ptr<SessionPeople> people_;
  Console* console_ = nullptr;  ///< they, where they are at a page
  DebriefPlan debrief_;
  double rate_Hz_ = 1000.0;
};

}  // namespace

int runEvaluation(EvaluateOptions& options) { return EvaluationSession(options).run(); }

}  // namespace app
