#include "app/review/session_comparison.h"

#include <algorithm>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "app/session/measures/rests_on.h"
#include "app/session/session_error.h"
#include "app/station/session_case.h"
#include "app/text/clock_text.h"
#include "app/text/usage_error.h"

namespace app {
namespace {

std::string number(const std::optional<double>& value) { return value ? fmt::format("{:.2f}", *value + 0.0) : "-"; }

nlohmann::ordered_json orNull(const std::optional<double>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
}

}  // namespace

std::vector<ComparedMeasure> comparedMeasures(const SessionComparison& c) {
  std::vector<ComparedMeasure> rows;
  const auto confirmed = [&c](std::string_view id) {
    return isConfirmed(id, c.a.proposed) && isConfirmed(id, c.b.proposed);
  };
  for (const Measure& measure : kMeasures)
    rows.push_back({std::string(measure.key), measure.meaning, measure.unit, c.a.*measure.value, c.b.*measure.value,
                    confirmed(measure.key)});
  for (const MeasureValue& measure : c.a.measures)
    rows.push_back({std::string(measure.id), measure.name, measure.unit, measure.value, valueOf(c.b, measure.id),
                    confirmed(measure.id)});
  return rows;
}

std::vector<ComparedStep> comparedSteps(const SessionComparison& c) {
  std::vector<ComparedStep> rows;
  if (!c.a.procedure || !c.b.procedure) return rows;
  for (const StepRecord& step : c.a.procedure->steps) {
    const auto same = std::ranges::find(c.b.procedure->steps, step.key, &StepRecord::key);
    rows.push_back({step.title, step.duration_s,
                    same == c.b.procedure->steps.end() ? std::nullopt : std::optional(same->duration_s)});
  }
  return rows;
}

ComparedEnds comparedEnds(const std::string& path_a, const std::string& path_b) {
  SessionReader a(path_a), b(path_b);
  for (auto* const one : {&a, &b}) {
    const std::string& path = one == &a ? path_a : path_b;
    refuseDamaged(*one, path);
    if (const auto log = one->missingLog()) throw missingLogError(path, *log);
  }
  ComparedEnds ends{a.start(), b.start(), {}, {}};
  if (!(ends.start_a.grid == ends.start_b.grid) || ends.start_a.label != ends.start_b.label ||
      ends.start_a.solid != ends.start_b.solid)
    throw UsageError(path_b + ": begins with another bone than " + path_a + ", compare two rehearsals of one case");
  ends.left_a = boneLeft(a, ends.start_a);
  ends.left_b = boneLeft(b, ends.start_b);
  return ends;
}

SessionComparison comparisonOf(const std::string& path_a, const std::string& path_b, const ComparedEnds& ends) {
  const StoredStart& start = ends.start_a;
  return {metricsOf(path_a, caseOfSession, &ends.left_a), metricsOf(path_b, caseOfSession, &ends.left_b),
          compareRemovals(start.grid, start.solid, ends.left_a.solid, ends.left_b.solid,
                          [&](std::size_t v) { return countsAsBone(start.label[v]); })};
}

std::string comparisonText(const SessionComparison& c) {
  std::string words =
      fmt::format("{}: {} min and {} min\n", c.a.patient_title, clockText(c.a.duration_s), clockText(c.b.duration_s));
  words +=
      fmt::format("bone removed: {:.1f} mm³ by both, {:.1f} mm³ by the first alone, {:.1f} mm³ by the second alone",
                  c.bone.both_mm3, c.bone.onlyInA_mm3(), c.bone.onlyInB_mm3());
  if (const auto dice = c.bone.dice()) words += fmt::format("; overlap (Dice) {:.2f}", *dice);
  words += "\n\n";
  const std::vector<ComparedStep> steps = comparedSteps(c);
  for (const ComparedStep& step : steps)
    words += fmt::format("{:>10} {:>10}  {}\n", clockText(step.a_s), step.b_s ? clockText(*step.b_s) : "-", step.title);
  if (!steps.empty()) words += "\n";
  words += fmt::format("{:>11} {:>11} {:>11}\n", "first", "second", "difference");
  for (const ComparedMeasure& row : comparedMeasures(c)) {
    if (isAmongMeasures(row.key)) continue;
    const std::string difference = row.a && row.b ? fmt::format("{:+.2f}", *row.b - *row.a + 0.0) : "-";
    words += fmt::format("{:>11} {:>11} {:>11} {:<8} {}{}\n", number(row.a), number(row.b), difference,
                         unitText(row.unit), row.name, row.is_confirmed ? "" : " (not confirmed)");
  }
  return words;
}

std::string comparisonJson(const SessionComparison& c) {
  nlohmann::ordered_json json = {{"patient", c.a.patient_title},
                                 {"bone",
                                  {{"first_mm3", c.bone.a_mm3},
                                   {"second_mm3", c.bone.b_mm3},
                                   {"both_mm3", c.bone.both_mm3},
                                   {"only_first_mm3", c.bone.onlyInA_mm3()},
                                   {"only_second_mm3", c.bone.onlyInB_mm3()},
                                   {"dice", orNull(c.bone.dice())}}},
                                 {"steps", nlohmann::ordered_json::array()},
                                 {"measures", nlohmann::ordered_json::array()}};
  for (const ComparedStep& step : comparedSteps(c))
    json["steps"].push_back({{"title", step.title}, {"first_s", step.a_s}, {"second_s", orNull(step.b_s)}});
  for (const ComparedMeasure& row : comparedMeasures(c)) {
    nlohmann::ordered_json entry = {
        {"id", row.key}, {"name", row.name}, {"unit", row.unit}, {"first", orNull(row.a)}, {"second", orNull(row.b)}};
    entry["difference"] = row.a && row.b ? nlohmann::ordered_json(*row.b - *row.a) : nullptr;
    entry["confirmed"] = row.is_confirmed;
    json["measures"].push_back(std::move(entry));
  }
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace app
