#include "app/evaluation/script.h"

#include <algorithm>
#include <array>
#include <utility>

#include <nlohmann/json.hpp>

#include "app/evaluation/evaluation_course.h"
#include "app/text/list.h"
#include "app/text/usage_error.h"
#include "assets/json_depth.h"
#include "assets/toml_reader.h"

namespace app {
namespace {

using nlohmann::json;

constexpr std::size_t kMostScriptBytes = 4U << 20U;
constexpr double kLongest_s = 86'400.0;

class ScriptLine {
 public:
  ScriptLine(std::string_view text, std::string where) : where_(std::move(where)) {
    if (assets::isNestedTooDeep(text)) refuse("", "is nested too deeply");
    json_ = json::parse(text.begin(), text.end(), nullptr, false);
    if (!json_.is_object()) refuse("", "is no JSON object, write one a line");
    for (const auto& [key, value] : json_.items())
      if (std::ranges::find(kKeys, key) == kKeys.end()) refuse(key, "no such key, give one of " + joined(kKeys));
  }

  [[noreturn]] void refuse(const std::string& key, const std::string& reason) const {
    throw UsageError(where_ + (key.empty() ? " " : ", " + key + ": ") + reason);
  }
  std::string text(const char* key) const {
    if (!json_.contains(key) || !json_[key].is_string()) refuse(key, "give a text in quotes");
    return json_[key];
  }
  bool isFor(const std::string& participant) const {
    if (!json_.contains("for")) return true;
    const json& names = json_["for"];
    if (!names.is_array() || !std::ranges::all_of(names, [](const json& one) { return one.is_string(); }))
      refuse("for", "give a list of codes like [\"P01\", \"P02\"]");
    return std::ranges::find(names, json(participant)) != names.end();
  }
  ScriptedEvent event() const {
    ScriptedEvent made;
    made.where = where_;
    made.during = text("during");
    if (json_.contains("at_s")) {
      const bool is_number = json_["at_s"].is_number();
      made.at_s = is_number ? json_["at_s"].get<double>() : -1.0;
      if (!(made.at_s >= 0.0 && made.at_s <= kLongest_s)) refuse("at_s", "give seconds, 0 to 86400");
    }
    made.event.source = json_.contains("src") ? text("src") : "evaluator";
    if (made.event.source != "evaluator" && made.event.source != "participant")
      refuse("src", "give evaluator or participant");
    made.event.type = text("type");
    if (!json_.contains("data")) return made;
    if (!json_["data"].is_object()) refuse("data", "give an object like {\"text\": \"…\"}");
    for (const auto& [key, value] : json_["data"].items()) made.event.data.emplace_back(key, datum(key, value));
    return made;
  }

 private:
  static constexpr std::array<std::string_view, 6> kKeys{"during", "at_s", "src", "type", "for", "data"};

  LogValue datum(const std::string& key, const json& value) const {
    if (value.is_boolean()) return value.get<bool>();
    if (value.is_number_integer()) return value.get<std::int64_t>();
    if (value.is_number_float()) return value.get<double>();
    if (!value.is_string()) refuse("data." + key, "give a text, a number, true or false");
    return value.get<std::string>();
  }

  std::string where_;
  json json_;
};

}  // namespace

EvaluationScript::EvaluationScript(std::string_view text, const std::string& where, const StudyTemplate& study,
                                   const std::string& participant) {
  int number = 0;
  for (const std::string_view line : split(text, '\n')) {
    ++number;
    if (line.find_first_not_of(" \r\t") == std::string_view::npos) continue;
    const ScriptLine one(line, where + " line " + std::to_string(number));
    ScriptedEvent event = one.event();
    const bool is_phase = std::ranges::find(kPhases, event.during) != kPhases.end();
    if (!is_phase && !study.taskNamed(event.during))
      one.refuse("during", "give a task of the template, or one of consent, warm-up, debrief, questionnaires, close");
    if (one.isFor(participant)) events_.push_back(std::move(event));
  }
  std::ranges::stable_sort(events_, {}, &ScriptedEvent::at_s);
}

std::vector<ScriptedEvent> EvaluationScript::takeDue(std::string_view during, double until_s) {
  std::vector<ScriptedEvent> due;
  for (auto one = events_.begin(); one != events_.end();) {
    if (one->during != during || one->at_s > until_s) {
      ++one;
      continue;
    }
    due.push_back(std::move(*one));
    one = events_.erase(one);
  }
  return due;
}

EvaluationScript evaluationScriptOf(const std::string& file, const StudyTemplate& study,
                                    const std::string& participant) {
  return {assets::readSmallFile(file, kMostScriptBytes), file, study, participant};
}

}  // namespace app
