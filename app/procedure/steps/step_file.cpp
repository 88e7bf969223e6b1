#include "app/procedure/steps/step_file.h"

#include <algorithm>
#include <array>
#include <set>
#include <span>

#include "app/text/list.h"
#include "app/text/usage_error.h"
#include "assets/toml_reader.h"

namespace app {
namespace {

struct ShippedProcedure {
  std::string_view name, text;
};
constexpr auto kShipped = std::to_array<ShippedProcedure>({
#include "shipped_procedures.inc"
});

constexpr std::size_t kMostSteps = 40, kMostInstruments = 8;
constexpr std::size_t kLongestKey = 24, kLongestTitle = 60, kLongestInstruction = 200;
constexpr assets::NumberRange kShare{0.01, 1.0, ""};
constexpr assets::NumberRange kVolume{0.1, 20000.0, "mm³"};
constexpr assets::NumberRange kForce{0.1, 500.0, "N"};

std::string shortText(assets::TomlReader& keys, const std::string& table, const std::string& key, std::size_t longest) {
  std::string text = keys.text(table, key);
  if (text.empty() || text.size() > longest)
    keys.refuse(table, key, "give 1 to " + std::to_string(longest) + " bytes of text in quotes");
  return text;
}

std::optional<double> numberIfGiven(assets::TomlReader& keys, const std::string& table, const std::string& key,
                                    const assets::NumberRange& range) {
  return keys.has(table, key) ? std::optional(keys.number(table, key, range)) : std::nullopt;
}

std::optional<int> countIfGiven(assets::TomlReader& keys, const std::string& table, const std::string& key, int low) {
  if (!keys.has(table, key)) return {};
  return static_cast<int>(keys.integer(table, key, low, 4));
}

template <class Kind, class Names>
Kind oneOf(assets::TomlReader& keys, const std::string& table, const std::string& key, const std::string& word,
           const Names& names) {
  const auto found = std::ranges::find(names, word);
  if (found == names.end()) keys.refuse(table, key, "no such choice, give one of " + joined(names));
  return static_cast<Kind>(found - names.begin());
}

std::string keyOf(assets::TomlReader& keys, const std::string& table, std::set<std::string>& known) {
  const std::string key = shortText(keys, table, "key", kLongestKey);
  const bool is_plain =
      std::ranges::all_of(key, [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-'; });
  if (!is_plain) keys.refuse(table, "key", "give small letters a to z, digits and '-' alone");
  if (!known.insert(key).second) keys.refuse(table, "key", "another step has this key, give each its own");
  return key;
}

DoneWhen doneWhen(assets::TomlReader& keys, const std::string& table) {
  DoneWhen when;
  if (keys.has(table, "given")) when.given = shortText(keys, table, "given", kLongestInstruction);
  if (keys.has(table, "in_hand"))
    when.in_hand = oneOf<StepInstrument>(keys, table, "in_hand", keys.text(table, "in_hand"),
                                         std::span(kStepInstruments).first<3>());
  when.incision_mm = numberIfGiven(keys, table, "incision_mm", {1.0, 100.0, "mm"});
  when.flap_raised = numberIfGiven(keys, table, "flap_raised", kShare);
  when.flap_held = keys.boolean(table, "flap_held", false);
  when.gutter_removed = numberIfGiven(keys, table, "gutter_removed", kShare);
  when.crown_bared = numberIfGiven(keys, table, "crown_bared", kShare);
  when.bone_mm3 = numberIfGiven(keys, table, "bone_mm3", kVolume);
  when.tooth_mm3 = numberIfGiven(keys, table, "tooth_mm3", kVolume);
  when.bridge_mm = numberIfGiven(keys, table, "bridge_mm", {0.3, 15.0, "mm"});
  when.torn = numberIfGiven(keys, table, "torn", kShare);
  when.pieces = countIfGiven(keys, table, "pieces", 2);
  when.pieces_out = countIfGiven(keys, table, "pieces_out", 1);
  when.all_out = keys.boolean(table, "all_out", false);
  when.chips_mm3 = numberIfGiven(keys, table, "chips_mm3", {0.05, 1000.0, "mm³"});
  when.follicle_left = numberIfGiven(keys, table, "follicle_left", kShare);
  when.edges_mm = numberIfGiven(keys, table, "edges_mm", {0.5, 200.0, "mm"});
  when.socket_clean = keys.boolean(table, "socket_clean", false);
  when.stitches = countIfGiven(keys, table, "stitches", 1);
  const bool has_rule = when.hasRule();
  if (has_rule == !when.given.empty())
    keys.refuse(table, "",
                has_rule ? "what is given is not done by hand, leave out given or the rules"
                         : "it says no rule, give one, like pieces = 2, or given = \"why it is not done by hand\"");
  return when;
}

StepErrorRules errorRules(assets::TomlReader& keys, const std::string& table) {
  StepErrorRules rules;
  rules.neighbour = keys.boolean(table, "neighbour", false);
  rules.canal = keys.boolean(table, "canal", false);
  rules.soft_tissue = keys.boolean(table, "soft_tissue", false);
  rules.dry = keys.boolean(table, "dry", false);
  rules.fulcrum = keys.boolean(table, "fulcrum", false);
  rules.wrong_instrument = keys.boolean(table, "wrong_instrument", false);
  rules.nerve_mm = numberIfGiven(keys, table, "nerve_mm", {0.1, 10.0, "mm"});
  rules.cutting_N = numberIfGiven(keys, table, "cutting_N", kForce);
  rules.pull_N = numberIfGiven(keys, table, "pull_N", kForce);
  rules.bone_mm3 = numberIfGiven(keys, table, "bone_mm3", kVolume);
  return rules;
}

Step stepAt(assets::TomlReader& keys, const std::string& table, std::set<std::string>& known) {
  Step step;
  step.key = keyOf(keys, table, known);
  step.title = shortText(keys, table, "title", kLongestTitle);
  if (keys.has(table, "instruction")) step.instruction = shortText(keys, table, "instruction", kLongestInstruction);
  if (keys.has(table, "instruments"))
    for (const std::string& word : keys.texts(table, "instruments", kMostInstruments))
      step.instruments.push_back(oneOf<StepInstrument>(keys, table, "instruments", word, kStepInstruments));
  step.region =
      oneOf<StepRegion>(keys, table, "region", keys.text(table, "region", std::string(kStepRegions[0])), kStepRegions);
  if (!keys.has(table + ".done_when"))
    keys.refuse(table, "done_when", "it is missing, give a table like { pieces = 2 }");
  step.done_when = doneWhen(keys, table + ".done_when");
  if (keys.has(table, "errors")) {
    if (!keys.has(table + ".errors")) keys.refuse(table, "errors", "give a table like { dry = true, nerve_mm = 2.0 }");
    step.errors = errorRules(keys, table + ".errors");
  }
  return step;
}

}  // namespace

std::vector<std::string> shippedProcedures() {
  std::vector<std::string> names;
  for (const ShippedProcedure& one : kShipped) names.emplace_back(one.name);
  return names;
}

std::string shippedProcedureText(const std::string& name) {
  return std::string(std::ranges::find(kShipped, name, &ShippedProcedure::name)->text);
}

StepPlan stepPlanFromToml(const std::string& text, const std::string& where) {
  assets::TomlReader keys(text, where);
  StepPlan plan;
  plan.name = "own";
  plan.title = shortText(keys, "", "title", kLongestTitle);
  std::set<std::string> known;
  const std::size_t steps = keys.tables("step", 1, kMostSteps);
  for (std::size_t n = 1; n <= steps; ++n) plan.steps.push_back(stepAt(keys, "step." + std::to_string(n), known));
  keys.refuseUnknownKeys();
  return plan;
}

StepPlan withFlapRaised(StepPlan plan) {
  for (Step& step : plan.steps) {
    DoneWhen& when = step.done_when;
    if (!when.asksForFlap()) continue;
    when.incision_mm.reset(), when.flap_raised.reset();
    when.flap_held = false;
    if (!when.hasRule()) when.given = "The flap is raised already";
  }
  return plan;
}

StepPlan stepPlanNamed(const std::string& name_or_file) {
  if (std::ranges::find(kShipped, name_or_file, &ShippedProcedure::name) != kShipped.end()) {
    StepPlan plan = stepPlanFromToml(shippedProcedureText(name_or_file), name_or_file);
    plan.name = name_or_file;
    return plan;
  }
  if (!name_or_file.ends_with(".toml"))
    throw UsageError("--procedure " + name_or_file + ": no such procedure, give one of " + joined(shippedProcedures()) +
                     " or a FILE.toml");
  return stepPlanFromToml(assets::readSmallFile(name_or_file), name_or_file);
}

}  // namespace app
