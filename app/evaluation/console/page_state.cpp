#include "app/evaluation/console/page_state.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "app/evaluation/task_measures.h"

namespace app {

/// Where something of the log lies in the recording: a note, a bookmark, a task.
struct LoggedMoment {
  std::size_t seq = 0;
  std::string type, text;
  std::optional<std::uint64_t> tick;
  double moment_s = 0.0;  ///< where there is no tick: as it was shown in the debrief
};

namespace {

using PageJson = nlohmann::ordered_json;

constexpr std::size_t kMostNotes = 400;  ///< the newest
constexpr double kPageSecond_ns = 1e9;

/// To so many digits after the point.
double rounded(double value, int digits) {
  const double scale = std::pow(10.0, digits);
  return std::round(value * scale) / scale;
}

PageJson orNull(const std::optional<double>& value, int digits) {
  return value && std::isfinite(*value) ? PageJson(rounded(*value, digits)) : PageJson();
}

std::string_view unitOf(std::string_view id) {
  const auto known = std::ranges::find(ruleMeasures(), id, &RuleMeasure::id);
  return known == ruleMeasures().end() ? std::string_view() : known->unit;
}

/// Of kConsentStreams, beside the consent's own text.
constexpr std::array<const char*, kConsentStreams.size()> kMeaningOfStream{
    "A log of what happens in the session", "Your voice", "Pictures of what you see", "Your own words, written down",
    "Use in further studies"};

PageJson ruleOf(const std::optional<Rule>& rule, const PageNow& now) {
  PageJson all = PageJson::array();
  if (!rule) return all;
  for (const Rule::Comparison& one : rule->comparisons()) {
    const auto value = now.measure ? now.measure(one.id) : std::nullopt;
    const auto holds = one.holds(value);
    const std::string unit(unitOf(one.id));
    all.push_back(
        {{"text", fmt::format("{} {} {:g}{}{}", one.id, one.comparator, one.limit, unit.empty() ? "" : " ", unit)},
         {"measure", one.id},
         {"value", orNull(value, 3)},
         {"unit", unit},
         {"limit", one.limit},
         {"op", one.comparator},
         {"holds", holds ? PageJson(*holds) : PageJson()}});
  }
  return all;
}

/// On one bar: what the log tells, and the incidents of the recording. Figures with all their digits: they are those
/// of `molar replay --to T --json`.
PageJson debriefOf(const PageNow::Debrief& of, const std::vector<LoggedMoment>& logged) {
  constexpr std::size_t kMostIncidents = 300;
  std::vector<std::pair<double, PageJson>> marks;
  for (const LoggedMoment& one : logged) {
    const double t_s = one.tick ? static_cast<double>(*one.tick) * of.tick_s : one.moment_s;
    marks.emplace_back(t_s, PageJson{{"t_s", t_s}, {"type", one.type}, {"text", one.text}, {"seq", one.seq}});
  }
  for (std::size_t n = 0; n < of.incidents.size() && n < kMostIncidents; ++n)
    marks.emplace_back(of.incidents[n].t_s,
                       PageJson{{"t_s", of.incidents[n].t_s}, {"type", "error"}, {"text", of.incidents[n].what}});
  std::ranges::stable_sort(marks, {}, &std::pair<double, PageJson>::first);
  PageJson all = PageJson::array();
  for (auto& [t_s, mark] : marks) all.push_back(std::move(mark));
  return {{"t_s", of.t_s},
          {"duration_s", of.length_s},
          {"prepared", of.prepared_share},
          {"playing", of.plays},
          {"speed", of.speed},
          {"tick", of.values.tick},
          {"force_N", of.values.force_N},
          {"removed_mm3", of.values.removed_mm3},
          {"bone_digest", fmt::format("{:016x}", of.values.bone_digest)},
          {"marks", std::move(all)}};
}

}  // namespace

struct PageState::Told {
  std::vector<LoggedMoment> moments;
  PageJson checks = PageJson::array(), notes = PageJson::array();
  std::map<std::string, int> prompts;
  std::map<std::string, PageJson> answers;  ///< by questionnaire
  std::size_t events = 0;
};

PageState::PageState(const StudyTemplate& study, const EvaluationCourse& course, std::string consent_text,
                     std::int64_t began_ns)
    : study_(study),
      course_(course),
      consent_text_(std::move(consent_text)),
      began_ns_(began_ns),
      told_(std::make_unique<Told>()) {}
PageState::~PageState() = default;

void PageState::add(const LogEvent& event) {
  constexpr std::array<std::string_view, 9> kShown{"note",       "prompt",    "bookmark",      "help",      "problem",
                                                   "task.start", "task.stop", "task.override", "task.pause"};
  const std::size_t number = told_->events++;
  if (event.type == "check")
    told_->checks.push_back(
        {{"name", event.textOr("name")}, {"light", event.textOr("light")}, {"words", event.textOr("words")}});
  if (event.type == "prompt") ++told_->prompts[event.textOr("prompt")];
  if (event.type == "answer") {
    PageJson& answers = told_->answers[event.textOr("questionnaire")];
    if (answers.is_null()) answers = PageJson::object();
    const auto value = event.number("value");
    const std::string* const words = event.text("words");
    answers[event.textOr("item")] = value ? PageJson(*value) : words != nullptr ? PageJson(*words) : PageJson();
  }
  if (std::ranges::find(kShown, event.type) == kShown.end() && event.type != "task.resume") return;
  PageJson note{{"seq", number},
                {"type", event.type},
                {"at_s", rounded(static_cast<double>(event.t_ns - began_ns_) / kPageSecond_ns, 3)}};
  for (const char* key : {"kind", "task", "result", "by", "prompt", "problem"})
    if (const std::string* const text = event.text(key)) note[key] = *text;
  for (const char* key : {"text", "label", "reason", "title"})
    if (const std::string* const text = event.text(key)) note["text"] = *text;
  if (const auto severity = event.number("severity")) note["severity"] = *severity;
  const auto moment_s = event.number("moment_s");
  if (event.tick || moment_s) {
    const std::string type = event.type.starts_with("task.") ? "task" : event.type;
    const std::string text = event.type == "problem" ? event.textOr("title")
                             : type == "task"        ? event.textOr("task") + " " + event.textOr("result")
                                                     : note.value("text", "");
    if (told_->moments.size() < kMostNotes)
      told_->moments.push_back({number, type, text, event.tick, moment_s.value_or(0.0)});
  }
  told_->notes.push_back(std::move(note));
  if (told_->notes.size() > kMostNotes) told_->notes.erase(told_->notes.begin());
}

std::string PageState::text(const PageNow& now) const {
  const Participant& who = course_.participant();
  PageJson state{{"kind", "state"},
                 {"now_ns", now.now_ns},
                 {"began_ns", now.began_ns},
                 {"serial", now.serial},
                 {"session", now.session},
                 {"title", study_.title},
                 {"participant", who.code},
                 {"visit", who.visit},
                 {"evaluator", who.evaluator},
                 {"language", study_.language},
                 {"phase", kPhases[static_cast<std::size_t>(course_.phase())]},
                 {"may_continue", now.may_continue},
                 {"hold", now.hold},
                 {"checks", told_->checks}};
  PageJson& phases = state["phases"] = PageJson::array();
  for (const std::string_view phase : kPhases)
    if (phase != "ended" && (phase != "warm-up" || !study_.warm_up_block.empty())) phases.push_back(phase);
  PageJson& streams = (state["consent"] = {{"text", consent_text_}})["streams"] = PageJson::array();
  for (std::size_t n = 0; n < kConsentStreams.size(); ++n) {
    const auto given = course_.wordOn(kConsentStreams[n]);
    streams.push_back(
        {{"id", kConsentStreams[n]}, {"say", kMeaningOfStream[n]}, {"given", given ? PageJson(*given) : PageJson()}});
  }
  state["warm_up"] = now.warm_up_left_s ? PageJson{{"left_s", rounded(*now.warm_up_left_s, 1)}} : PageJson();
  const TaskTemplate* const task = course_.running();
  state["task"] = PageJson();
  if (task != nullptr)
    state["task"] = {{"id", task->id},
                     {"say", task->say},
                     {"place", course_.outcomes().size()},
                     {"of", course_.order().size()},
                     {"elapsed_s", rounded(now.task_s, 1)},
                     {"time_box_s", task->time_box_s},
                     {"box_over", course_.isTimeBoxOver()},
                     {"helps", course_.outcomes().back().helps},
                     {"paused", course_.isPaused()},
                     {"success", ruleOf(task->success, now)},
                     {"fail", ruleOf(task->fail, now)}};
  PageJson& tasks = state["tasks"] = PageJson::array();
  for (std::size_t n = 0; n < course_.order().size(); ++n) {
    const TaskTemplate& one = study_.tasks[course_.order()[n]];
    PageJson row{{"id", one.id}, {"say", one.say}, {"result", nullptr}};
    if (n < course_.outcomes().size() && course_.outcomes()[n].result) {
      const TaskOutcome& outcome = course_.outcomes()[n];
      row["result"] = kTaskResults[static_cast<std::size_t>(*outcome.result)];
      row["by"] = outcome.by, row["reason"] = outcome.reason, row["time_s"] = rounded(outcome.time_s, 1);
    }
    tasks.push_back(std::move(row));
  }
  PageJson& prompts = state["prompts"] = PageJson::array();
  for (const PromptTemplate& prompt : study_.prompts) {
    const auto said = told_->prompts.find(prompt.id);
    prompts.push_back(
        {{"id", prompt.id}, {"say", prompt.say}, {"said", said == told_->prompts.end() ? 0 : said->second}});
  }
  state["notes"] = told_->notes;
  PageJson& points = state["course"] = PageJson::array();
  for (const PageNow::Point& one : now.course)
    points.push_back({{"t_s", rounded(one.t_s, 3)},
                      {"clearance_mm", orNull(one.clearance_mm, 2)},
                      {"force_N", rounded(one.force_N, 3)}});
  state["servo"] =
      now.servo ? PageJson{{"rate_Hz", rounded(now.servo->rate_Hz, 1)}, {"missed", now.servo->missed}} : PageJson();
  state["recording"] = now.is_recording;
  if (!now.not_kept.empty()) state["not_kept"] = now.not_kept;
  state["seat"] = now.seat_lag_ms ? PageJson{{"lag_ms", rounded(*now.seat_lag_ms, 1)}} : PageJson();
  state["voice"] = now.voice ? PageJson{{"level_dB", rounded(now.voice->level_db, 1)},
                                        {"speech", now.voice->speech},
                                        {"quiet_s", rounded(now.voice->quiet_s, 1)},
                                        {"reminder", now.voice->reminder}}
                             : PageJson();
  PageJson& asked = state["questionnaires"] = PageJson::array();
  for (const AskedQuestionnaire* one : study_.questionnairesFor(who.group)) {
    const Questionnaire& of = one->questionnaire;
    const bool is_now = course_.phase() == (of.isOfWords() ? Phase::debrief : Phase::questionnaires);
    if (!is_now) continue;
    PageJson items = PageJson::array();
    for (const QuestionItem& item : of.items) {
      PageJson row{{"id", item.id}, {"say", item.says}};
      if (!of.isOfWords()) {
        const std::vector<std::string>& words = item.choices.empty() ? of.scale : item.choices;
        row["from"] = of.lowOf(item), row["to"] = of.highOf(item);
        row["low"] = words.empty() ? "" : words.front(), row["high"] = words.empty() ? "" : words.back();
        row["scale"] = words;
        if (!item.choices.empty()) row["choices"] = item.choices;
      }
      items.push_back(std::move(row));
    }
    const auto answers = told_->answers.find(of.id);
    asked.push_back({{"id", of.id},
                     {"title", of.title},
                     {"words", of.isOfWords()},
                     {"items", std::move(items)},
                     {"answers", answers == told_->answers.end() ? PageJson::object() : answers->second},
                     {"locked", course_.isLocked(of.id)}});
  }
  state["debrief"] = now.debrief ? debriefOf(*now.debrief, told_->moments) : PageJson();
  if (!now.debrief_trouble.empty()) state["debrief_trouble"] = now.debrief_trouble;
  state["closing"] = PageJson();
  if (now.closing)
    state["closing"] = {{"done", now.closing->is_done},
                        {"verified", now.closing->is_verified},
                        {"rules", now.closing->rules},
                        {"deviate", now.closing->deviate},
                        {"folder", now.closing->folder}};
  return state.dump(-1, ' ', false, PageJson::error_handler_t::replace);
}

}  // namespace app
