#include "app/session/step_event.h"

#include <algorithm>
#include <array>

#include <fmt/core.h>

#include "app/text/clock_text.h"
#include "app/text/parse_number.h"

namespace app {
namespace {

constexpr std::array<std::string_view, 6> kStepStates = {"not reached", "open", "met", "given", "skipped", "omitted"};

bool hasEnded(const StepRecord& step) { return step.state > StepState::open; }

/// Takes `words` off the front; false: it begins otherwise.
bool takeWords(std::string_view& text, std::string_view words) {
  if (!text.starts_with(words)) return false;
  text.remove_prefix(words.size());
  return true;
}

/// Takes what stands before `end`, and `end`.
std::optional<std::string> takeUntil(std::string_view& text, std::string_view end) {
  const std::size_t at = text.find(end);
  if (at == std::string_view::npos) return {};
  std::string before(text.substr(0, at));
  text.remove_prefix(at + end.size());
  return before;
}

std::optional<double> takeNumber(std::string_view& text, std::string_view end) {
  const auto words = takeUntil(text, end);
  return words ? parseNumber<double>(*words) : std::nullopt;
}

StepRecord& stepOf(ProcedureRun& run, const std::string& key) {
  const auto known = std::ranges::find(run.steps, key, &StepRecord::key);
  if (known != run.steps.end()) return *known;
  return run.steps.emplace_back(StepRecord{.key = key, .title = key});
}

void beginStep(ProcedureRun& run, std::string_view text) {
  const auto key = takeUntil(text, " at ");
  const auto t_s = key ? takeNumber(text, " s: ") : std::nullopt;
  if (!t_s) return;
  StepRecord& step = stepOf(run, *key);
  step.title = text;
  step.state = StepState::open;
  step.begin_s = t_s;
}

void addError(ProcedureRun& run, std::string_view text) {
  const auto key = takeUntil(text, " at ");
  if (key && takeNumber(text, " s: ")) stepOf(run, *key).count(std::string(text));
}

/// "gutter: met, 40.200 s", "close: not reached: Close".
void endStep(ProcedureRun& run, std::string_view text) {
  const auto key = takeUntil(text, ": ");
  if (!key) return;
  for (std::size_t n = 0; n < kStepStates.size(); ++n) {
    std::string_view rest = text;
    if (!takeWords(rest, kStepStates[n])) continue;
    StepRecord& step = stepOf(run, *key);
    step.state = static_cast<StepState>(n);
    if (takeWords(rest, ": "))
      step.title = rest;
    else if (takeWords(rest, ", "))
      step.duration_s = takeNumber(rest, " s").value_or(0.0);
  }
}

std::string difficultyWithIndex(const Prediction& p) {
  return p.index ? fmt::format("{} ({:.0f} of 10)", p.computed, *p.index) : p.computed;
}

}  // namespace

std::string_view nameOf(StepState state) { return kStepStates[static_cast<std::size_t>(state)]; }

void StepRecord::count(const std::string& error) {
  const auto known = std::ranges::find(errors, error, &std::pair<std::string, int>::first);
  if (known == errors.end())
    errors.emplace_back(error, 1);
  else
    ++known->second;
}

bool ProcedureRun::isComplete() const { return !steps.empty() && std::ranges::all_of(steps, hasEnded); }

std::optional<double> ProcedureRun::end_s() const {
  std::optional<double> last_s;
  for (const StepRecord& step : steps)
    if (step.begin_s) last_s = std::max(last_s.value_or(0.0), *step.begin_s + step.duration_s);
  return isComplete() ? last_s : std::nullopt;
}

std::string procedureText(const ProcedureRun& run) {
  return fmt::format("procedure {}, {}, {} steps", run.name, run.guidance, run.steps.size());
}

std::string stepBeginText(const StepRecord& step) {
  return fmt::format("begin {} at {:.3f} s: {}", step.key, step.begin_s.value_or(0.0), step.title);
}

std::string stepErrorText(const StepRecord& step, const std::string& error, double t_s) {
  return fmt::format("error in {} at {:.3f} s: {}", step.key, t_s, error);
}

std::string stepEndText(const StepRecord& step) {
  if (!step.begin_s) return fmt::format("end {}: {}: {}", step.key, nameOf(step.state), step.title);
  return fmt::format("end {}: {}, {:.3f} s", step.key, nameOf(step.state), step.duration_s);
}

void addStepEvent(std::optional<ProcedureRun>& run, const std::string& text) {
  std::string_view rest = text;
  if (takeWords(rest, "procedure ")) {
    const auto name = takeUntil(rest, ", ");
    const auto guidance = name ? takeUntil(rest, ", ") : std::nullopt;
    if (guidance) run = ProcedureRun{*name, *guidance, {}};
    return;
  }
  if (!run) return;
  if (takeWords(rest, "begin ")) return beginStep(*run, rest);
  if (takeWords(rest, "error in ")) return addError(*run, rest);
  if (takeWords(rest, "end ")) endStep(*run, rest);
}

std::string predictionText(const Prediction& p) {
  std::string text = fmt::format("at {:.3f} s", p.at_s);
  if (!p.difficulty.empty()) text += "; difficulty " + p.difficulty;
  if (p.minutes) text += fmt::format("; minutes {:.0f}", *p.minutes);
  if (!p.computed.empty()) text += "; computed " + p.computed;
  if (p.index) text += fmt::format("; index {:.0f}", *p.index);
  return text;
}

std::optional<Prediction> predictionFrom(const std::string& text) {
  std::string_view rest = text;
  Prediction p;
  if (!takeWords(rest, "at ")) return {};
  const auto at_s = takeNumber(rest, " s");
  if (!at_s) return {};
  p.at_s = *at_s;
  while (takeWords(rest, "; ")) {
    const std::size_t end = std::min(rest.find(';'), rest.size());
    std::string_view item = rest.substr(0, end);
    rest.remove_prefix(end);
    if (takeWords(item, "difficulty "))
      p.difficulty = item;
    else if (takeWords(item, "minutes "))
      p.minutes = parseNumber<double>(item);
    else if (takeWords(item, "computed "))
      p.computed = item;
    else if (takeWords(item, "index "))
      p.index = parseNumber<double>(item);
  }
  return p;
}

std::string predictionInWords(const Prediction& p, double end_s) {
  if (!p.isGiven()) return "";
  std::string words = p.difficulty;
  if (p.minutes) words += fmt::format("{}{:.0f} min", words.empty() ? "" : ", ", *p.minutes);
  words += "; computed: " + (p.computed.empty() ? "not known" : difficultyWithIndex(p));
  return words + fmt::format("; used: {:.1f} min", (end_s - p.at_s) / 60.0);
}

std::vector<std::string> stepsInWords(const ProcedureRun& run) {
  std::vector<std::string> lines;
  for (std::size_t n = 0; n < run.steps.size(); ++n) {
    const StepRecord& step = run.steps[n];
    std::string line = fmt::format("{} {}: {}", n + 1, step.title, nameOf(step.state));
    if (step.state != StepState::given && step.begin_s) line += " after " + clockText(step.duration_s);
    for (const auto& [error, times] : step.errors)
      line += fmt::format("; {} {}", error, times == 1 ? std::string("once") : fmt::format("{} times", times));
    lines.push_back(line);
  }
  return lines;
}

std::string procedureInWords(const ProcedureRun& run) {
  std::string words = fmt::format("{}, {}", run.name, run.guidance);
  std::string counts;
  for (const StepState state : {StepState::met, StepState::given, StepState::skipped, StepState::omitted,
                                StepState::open, StepState::not_reached})
    if (const auto n = std::ranges::count(run.steps, state, &StepRecord::state); n > 0)
      counts += fmt::format("{}{} {}", counts.empty() ? ": " : ", ", n, nameOf(state));
  int errors = 0;
  for (const StepRecord& step : run.steps)
    for (const auto& error : step.errors) errors += error.second;
  return words + counts +
         fmt::format(" of {} steps; {}", run.steps.size(),
                     errors == 0   ? std::string("no error")
                     : errors == 1 ? std::string("one error")
                                   : fmt::format("{} errors", errors));
}

}  // namespace app
