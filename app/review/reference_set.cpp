#include "app/review/reference_set.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "app/session/data_folder.h"
#include "app/session/gates.h"
#include "app/session/measures/painting.h"
#include "app/text/usage_error.h"
#include "assets/json_depth.h"
#include "calibration/record/utc.h"

namespace app {
namespace {

using SetJson = nlohmann::ordered_json;

struct Graded {
  std::string_view id;
  int better;  ///< 1: more is, -1: less is
};
constexpr std::array kGraded{
    Graded{"M1.total", -1}, Graded{"M3.rate", 1},   Graded{"M5.SPARC", 1},
    Graded{"PI", 1},        Graded{"S4.canal", -1}, Graded{"S7", -1},
    Graded{"S10.dry", -1},  Graded{"O3.over", -1},  Graded{"O3.under", -1},
};

int betterOf(std::string_view id) {
  const auto found = std::ranges::find(kGraded, id, &Graded::id);
  return found == kGraded.end() ? 0 : found->better;
}

SetJson histogramsJson(const ContactEnvelope::ByBand& by_band) {
  SetJson bands = SetJson::array();
  for (const auto& histogram : by_band) {
    // What is empty at the end is left out.
    const auto last = std::ranges::find_if(histogram.rbegin(), histogram.rend(), [](double s) { return s > 0.0; });
    bands.push_back(std::vector<double>(histogram.begin(), last.base()));
  }
  return bands;
}

bool isNumber(const SetJson& json) { return json.is_number() && std::isfinite(json.get<double>()); }

bool readHistograms(const SetJson& json, ContactEnvelope::ByBand& by_band) {
  if (!json.is_array() || json.size() != by_band.size()) return false;
  for (std::size_t band = 0; band < by_band.size(); ++band) {
    if (!json[band].is_array() || json[band].size() > ContactEnvelope::kClasses) return false;
    for (std::size_t n = 0; n < json[band].size(); ++n) {
      if (!isNumber(json[band][n]) || json[band][n].get<double>() < 0.0) return false;
      by_band[band][n] = json[band][n].get<double>();
    }
  }
  return true;
}

bool isName(const std::string& name) {
  constexpr std::size_t kLongest = 64;
  return !name.empty() && name.size() <= kLongest && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  });
}

std::vector<double> valuesIn(const ReferenceSet& set, std::string_view id) {
  std::vector<double> values;
  for (const ReferenceSet::Run& run : set.runs)
    if (const auto found = run.values.find(std::string(id)); found != run.values.end()) values.push_back(found->second);
  return values;
}

/// None: fewer than three, or no spread.
std::optional<double> zOf(double value, const std::vector<double>& values) {
  if (values.size() < kLeastRuns) return {};
  const auto n = static_cast<double>(values.size());
  double sum = 0.0, squares = 0.0;
  for (const double one : values) sum += one;
  const double mean = sum / n;
  for (const double one : values) squares += (one - mean) * (one - mean);
  const double deviation = std::sqrt(squares / (n - 1.0));
  return deviation > 1e-9 * std::max(1.0, std::abs(mean)) ? std::optional((value - mean) / deviation) : std::nullopt;
}

/// Median of the graded, better is positive; none: nothing is graded.
std::optional<double> zOfRun(const SessionMetrics& run, const ReferenceSet& set) {
  std::vector<double> zs;
  for (const Score& score : scoresOf(run, set))
    if (score.better != 0 && score.z) zs.push_back(score.better * *score.z);
  return medianOf(zs);
}

std::string number(double value) { return fmt::format("{:.2f}", value + 0.0); }

}  // namespace

ReferenceSet referenceOf(const std::string& name, std::span<const SessionMetrics> runs) {
  ReferenceSet set;
  set.name = name;
  set.made_utc = calibration::nowUtc();
  for (const SessionMetrics& run : runs) {
    if (!set.runs.empty() && run.patient_title != set.case_title)
      throw UsageError("the runs of a set are of one case: " + set.case_title + " and " + run.patient_title +
                       " are two, name sessions of one");
    set.case_title = run.patient_title;
    ReferenceSet::Run& one = set.runs.emplace_back();
    one.program = run.program_version;
    for (const MeasureValue& measure : run.measures)
      if (measure.value) one.values.emplace(measure.id, *measure.value);
    set.envelope.add(run.envelope);
  }
  return set;
}

std::string referenceText(const ReferenceSet& set) {
  SetJson json = {{"molar_reference", 1},
                  {"name", set.name},
                  {"case", set.case_title},
                  {"made_utc", set.made_utc},
                  {"runs", SetJson::array()}};
  for (const ReferenceSet::Run& run : set.runs)
    json["runs"].push_back({{"program", run.program}, {"values", run.values}});
  json["envelope"] = {{"force_s", histogramsJson(set.envelope.force_s)},
                      {"speed_s", histogramsJson(set.envelope.speed_s)}};
  return json.dump(2, ' ', false, SetJson::error_handler_t::replace) + "\n";
}

ReferenceSet referenceFromText(const std::string& text, const std::string& where) {
  const SetJson json = assets::isNestedTooDeep(text) ? SetJson() : SetJson::parse(text, nullptr, false);
  const auto refuse = [&where](const char* what) {
    throw UsageError(where + ": is no reference set (" + what + "), make one with molar reference");
  };
  if (!json.is_object() || json.value("molar_reference", SetJson()) != SetJson(1)) refuse("it does not say so");
  ReferenceSet set;
  const auto words = [&](const char* key, std::string& to) {
    const auto found = json.find(key);
    if (found == json.end() || !found->is_string()) refuse(key);
    to = found->get<std::string>();
  };
  words("name", set.name), words("case", set.case_title), words("made_utc", set.made_utc);
  const auto runs = json.find("runs");
  if (!isName(set.name) || runs == json.end() || !runs->is_array()) refuse("name or runs");
  for (const SetJson& one : *runs) {
    const auto values = one.is_object() ? one.find("values") : one.end();
    if (!one.is_object() || values == one.end() || !values->is_object()) refuse("a run");
    ReferenceSet::Run& run = set.runs.emplace_back();
    if (const auto program = one.find("program"); program != one.end() && program->is_string())
      run.program = program->get<std::string>();
    for (const auto& [id, value] : values->items()) {
      if (!isNumber(value)) refuse("a value");
      run.values.emplace(id, value.get<double>());
    }
  }
  const auto envelope = json.find("envelope");
  if (envelope != json.end() &&
      (!envelope->is_object() || !envelope->contains("force_s") || !envelope->contains("speed_s") ||
       !readHistograms(envelope->at("force_s"), set.envelope.force_s) ||
       !readHistograms(envelope->at("speed_s"), set.envelope.speed_s)))
    refuse("its envelope");
  return set;
}

std::string referenceFile(const std::string& name) {
  if (!isName(name)) throw UsageError(name + ": is no name of a set, use letters, digits, - and _ (64 at most)");
  return (dataFolder("references") / (name + ".json")).string();
}

ReferenceSet loadReference(const std::string& name_or_file) {
  constexpr std::uintmax_t kLargest_bytes = 64U << 20U;
  const bool is_file = name_or_file.ends_with(".json");
  const std::string file = is_file ? name_or_file : referenceFile(name_or_file);
  std::error_code failed;
  if (!std::filesystem::is_regular_file(file, failed)) {
    std::string known;
    for (const std::string& name : referenceNames()) known += (known.empty() ? "" : ", ") + name;
    throw UsageError("--reference " + name_or_file + ": there is no such set, " +
                     (known.empty() ? "make one with molar reference" : "there are " + known));
  }
  if (std::filesystem::file_size(file, failed) > kLargest_bytes || failed)
    throw UsageError("--reference " + name_or_file + ": is too large for a reference set, name another");
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw UsageError("--reference " + name_or_file + ": cannot be read, check its rights");
  return referenceFromText(text.str(), "--reference " + name_or_file);
}

std::vector<std::string> referenceNames() {
  std::vector<std::string> names;
  std::error_code failed;
  for (const auto& entry : std::filesystem::directory_iterator(dataFolder("references"), failed))
    if (entry.path().extension() == ".json" && isName(entry.path().stem().string()))
      names.push_back(entry.path().stem().string());
  std::ranges::sort(names);
  return names;
}

void refuseOtherCase(const std::string& case_title, const ReferenceSet& set) {
  if (case_title != set.case_title)
    throw UsageError("--reference " + set.name + ": is of another case (" + set.case_title + "), name a set of " +
                     case_title);
}

std::vector<Score> scoresOf(const SessionMetrics& run, const ReferenceSet& set) {
  refuseOtherCase(run.patient_title, set);
  std::vector<Score> scores;
  for (const MeasureValue& measure : run.measures) {
    const std::vector<double> values = valuesIn(set, measure.id);
    if (!measure.value || values.empty()) continue;
    const auto [low, high] = std::ranges::minmax(values);
    scores.push_back({measure.id, measure.name, measure.unit, *measure.value, *medianOf(values), low, high,
                      zOf(*measure.value, values), betterOf(measure.id), measure.is_confirmed});
  }
  return scores;
}

void tellAgainst(SessionMetrics& run, const ReferenceSet& set) {
  refuseOtherCase(run.patient_title, set);
  const auto tell = [&](std::string_view id, const ContactEnvelope::ByBand& own,
                        const ContactEnvelope::ByBand& experts) {
    const auto found = std::ranges::find(run.measures, id, &MeasureValue::id);
    if (found == run.measures.end()) return;
    found->value = ContactEnvelope::shareAbove(own, experts);
    found->why = found->value ? std::string_view() : "the set has no work at these distances";
    if (found->value) found->conditions = fmt::format("against {}, {} runs", set.name, set.runs.size());
  };
  tell("S6.force", run.envelope.force_s, set.envelope.force_s);
  tell("S6.speed", run.envelope.speed_s, set.envelope.speed_s);
}

Grade gradeOf(std::span<const SessionMetrics> runs, const ReferenceSet& set) {
  Grade grade;
  if (set.runs.size() < kLeastRuns) {
    grade.words = fmt::format("no grade: the set {} has {} runs, {} are needed", set.name, set.runs.size(), kLeastRuns);
    return grade;
  }
  if (runs.size() < kLeastRuns) {
    grade.words = fmt::format("no grade: {} of {} runs", runs.size(), kLeastRuns);
    return grade;
  }
  std::vector<double> zs;
  for (const SessionMetrics& run : runs)
    if (const auto z = zOfRun(run, set)) zs.push_back(*z);
  if (zs.size() < kLeastRuns) {
    grade.words = "no grade: the runs have too little in common with the set";
    return grade;
  }
  grade.z = medianOf(zs);
  const auto [low, high] = std::ranges::minmax(zs);
  grade.low = low, grade.high = high;
  std::string gates;
  for (const SessionMetrics& run : runs)
    for (const Gate& gate : gatesOf(run))
      if (gate.is_open.value_or(false) && gates.find(gate.name) == std::string::npos)
        gates += (gates.empty() ? "" : ", ") + std::string(gate.name);
  constexpr double kBelow = -1.0, kFarBelow = -2.0;
  grade.words = !gates.empty()          ? "no grade: " + gates
                : *grade.z >= kBelow    ? "as the set " + set.name
                : *grade.z >= kFarBelow ? "below the set " + set.name
                                        : "well below the set " + set.name;
  return grade;
}

std::string scoresText(const SessionMetrics& run, const ReferenceSet& set) {
  std::string words = fmt::format("Against {}, {} runs of {}\n", set.name, set.runs.size(), set.case_title);
  for (const Gate& gate : gatesOf(run))
    words += fmt::format("  {:<38} {}{}{}\n", gate.name,
                         !gate.is_open   ? "not known"
                         : *gate.is_open ? "YES"
                                         : "no",
                         gate.is_open && !gate.is_confirmed ? " (not confirmed)" : "",
                         gate.words.empty() ? "" : ", " + gate.words);
  words += fmt::format("\n{:>11} {:>11} {:>23} {:>7}\n", "this run", "median", "range", "z");
  for (const Score& score : scoresOf(run, set)) {
    if (isAmongMeasures(score.id) && score.better == 0) continue;
    words +=
        fmt::format("{:>11} {:>11} {:>23} {:>7} {:<8} {}{}\n", number(score.value), number(score.median),
                    number(score.low) + " to " + number(score.high), score.z ? fmt::format("{:+.1f}", *score.z) : "-",
                    unitText(score.unit), score.name, score.is_confirmed ? "" : " (not confirmed)");
  }
  if (set.runs.size() < kLeastRuns) words += fmt::format("no z: it needs a set of {} runs\n", kLeastRuns);
  words += fmt::format("no grade of one run: from {} runs on, molar trend --reference {}\n", kLeastRuns, set.name);
  return words + "conditions: " + run.program_version + "; " + conditionsInWords(run.conditions) + "; calibration " +
         (run.calibration ? calibrationText(*run.calibration) : "not recorded") +
         fmt::format("; {} ticks not recorded\n", run.lost);
}

std::string scoresJson(const SessionMetrics& run, const ReferenceSet& set) {
  SetJson json = SetJson::parse(metricsJson(run));
  SetJson scores = SetJson::array();
  for (const Score& score : scoresOf(run, set)) {
    SetJson one = {{"id", score.id},     {"value", score.value}, {"unit", score.unit}, {"median", score.median},
                   {"least", score.low}, {"most", score.high},   {"z", nullptr},       {"better", score.better}};
    if (score.z) one["z"] = *score.z;
    one["confirmed"] = score.is_confirmed;
    scores.push_back(std::move(one));
  }
  json["reference"] = {{"name", set.name}, {"runs", set.runs.size()}, {"scores", std::move(scores)}};
  return json.dump(2, ' ', false, SetJson::error_handler_t::replace) + "\n";
}

}  // namespace app
