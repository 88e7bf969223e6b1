#include "app/psychophysics/protocol.h"

#include <algorithm>
#include <cmath>

#include "app/options/law_text.h"
#include "app/options/settings_text.h"
#include "app/options/tool_text.h"
#include "app/text/anonymous_id.h"
#include "app/text/usage_error.h"
#include "assets/toml_reader.h"

namespace app {
namespace {

constexpr std::size_t kMostLevels = 50;
constexpr std::int64_t kMostTrials = 5000;
constexpr double kFarthest_mm = 1e4;

BoneChoice boneOf(assets::TomlReader& keys) {
  BoneChoice bone;
  const int sources = keys.has("bone", "phantom") + keys.has("bone", "volume") + keys.has("bone", "patient");
  if (sources > 1) keys.refuse("bone", "", "more than one bone is named, keep one of phantom, volume and patient");
  const auto site = [&] {
    ProbeSite at;
    at.surface_P = {keys.vector("bone", "site_P_mm", kFarthest_mm)};
    const glm::dvec3 outward = keys.vector("bone", "outward_P", 10.0);
    if (!(glm::length(outward) > 1e-3)) keys.refuse("bone", "outward_P", "it has no direction, give three numbers");
    at.outward_P = {glm::normalize(outward)};
    return at;
  };
  if (keys.has("bone", "volume")) {
    bone.kind = BoneChoice::Kind::volume;
    bone.path = keys.text("bone", "volume");
    bone.is_hounsfield = keys.choice("bone", "field", {"hu", "solid"}, 0) == 0;
    bone.site = site();
  } else if (keys.has("bone", "patient")) {
    bone.kind = BoneChoice::Kind::patient;
    bone.path = keys.text("bone", "patient");
    if (bone.path == "built-in") bone.path.clear();
    if (keys.has("bone", "site_P_mm")) bone.site = site();
  } else {
    bone.kind = keys.choice("bone", "phantom", {"flat", "trabecular"}, 0) == 0 ? BoneChoice::Kind::flat
                                                                               : BoneChoice::Kind::trabecular;
    bone.voxel_mm = keys.number("bone", "voxel_mm", {0.05, 0.5, "mm"}, 0.2);
    if (bone.kind == BoneChoice::Kind::trabecular)
      bone.seed = static_cast<std::uint64_t>(keys.integer("bone", "seed", 0, 1'000'000'000, 1));
  }
  return bone;
}

haptics::Tool toolOf(assets::TomlReader& keys) {
  haptics::Tool tool;
  const std::string head = keys.text("tool", "head", "sphere:2");
  try {
    tool.head = headFrom(head);
  } catch (const UsageError&) {
    keys.refuse("tool", "head", "no such head, give sphere:R, capsule:R,L, cylinder:R,L or cone:R,L in mm");
  }
  return tool;
}

ProbePlan probeOf(assets::TomlReader& keys) {
  ProbePlan plan;
  plan.motion = static_cast<Motion>(keys.choice("probe", "motion", {"tap", "press", "stroke", "free"}, 1));
  plan.reach_mm = keys.number("probe", "reach_mm", {0.1, 10.0, "mm"}, plan.reach_mm);
  plan.duration_s = keys.number("probe", "duration_s", {0.1, 30.0, "s"}, plan.duration_s);
  if (plan.motion == Motion::stroke)
    plan.stroke_mm = keys.number("probe", "stroke_mm", {0.1, 30.0, "mm"}, plan.stroke_mm);
  plan.grip_N_per_mm = keys.number("probe", "grip_N_per_mm", {0.05, 5.0, "N/mm"}, plan.grip_N_per_mm);
  plan.spread = keys.number("probe", "spread", {0.0, 0.5, ""}, plan.spread);
  plan.wander_mm = keys.number("probe", "wander_mm", {0.0, 5.0, "mm"}, plan.wander_mm);
  plan.rate_Hz = keys.number("probe", "rate_Hz", {500.0, 4000.0, "Hz"}, plan.rate_Hz);
  return plan;
}

/// [standard] or [comparison]: a law and any of its parameters.
haptics::LawSettings lawOf(assets::TomlReader& keys, const std::string& table) {
  haptics::LawSettings law;
  const std::string name = keys.text(table, "law", "agus");
  try {
    law.kind = lawNamed(name);
  } catch (const UsageError&) {
    keys.refuse(table, "law", "no such law, give one of " + lawNames());
  }
  for (const auto& [key, setting] : parametersOf(law))
    *setting.value = keys.number(table, key, {setting.low, setting.high, setting.unit}, *setting.value);
  return law;
}

/// The varied parameter, within its range in the law.
Setting variedOf(assets::TomlReader& keys, Protocol& protocol) {
  protocol.parameter = keys.text("vary", "parameter");
  const auto known = parametersOf(protocol.comparison);
  const auto found = known.find(protocol.parameter);
  if (found == known.end()) {
    std::string names;
    for (const auto& [name, setting] : known) names += (names.empty() ? "" : ", ") + name;
    keys.refuse("vary", "parameter", "the law of the comparison has no such parameter, give one of " + names);
  }
  protocol.unit = found->second.unit;
  return found->second;
}

void readConstant(assets::TomlReader& keys, Protocol& protocol) {
  const Setting varied = variedOf(keys, protocol);
  protocol.levels = keys.numbers("vary", "levels", {varied.low, varied.high, varied.unit}, 2, kMostLevels);
  for (std::size_t i = 1; i < protocol.levels.size(); ++i)
    if (!(protocol.levels[i] > protocol.levels[i - 1]))
      keys.refuse("vary", "levels", "the levels must rise, put them in order and leave out doubles");
  protocol.trials = static_cast<int>(keys.integer("vary", "repetitions", 1, 500, 20));
  if (static_cast<std::int64_t>(protocol.levels.size()) * protocol.trials > kMostTrials)
    keys.refuse("vary", "repetitions", "that is more than 5000 trials, give fewer");
}

void readStaircase(assets::TomlReader& keys, Protocol& protocol) {
  const Setting varied = variedOf(keys, protocol);
  StaircaseRule& rule = protocol.staircase;
  rule.low = varied.low, rule.high = varied.high;
  protocol.levels = keys.numbers("staircase", "start", {varied.low, varied.high, varied.unit}, 1, 8);
  rule.up = static_cast<int>(keys.integer("staircase", "up", 1, 8, 1));
  rule.down = static_cast<int>(keys.integer("staircase", "down", 1, 8, 2));
  rule.kind = keys.choice("staircase", "step_kind", {"added", "ratio"}, 0) == 0 ? StepKind::added : StepKind::ratio;
  const assets::NumberRange steps = rule.kind == StepKind::ratio
                                        ? assets::NumberRange{1.001, 10.0, ""}
                                        : assets::NumberRange{1e-6, varied.high - varied.low, varied.unit};
  rule.steps = keys.numbers("staircase", "steps", steps, 1, 20);
  rule.reversals_per_step = static_cast<int>(keys.integer("staircase", "reversals_per_step", 1, 50, 2));
  rule.up_to_down = keys.number("staircase", "up_to_down", {0.1, 10.0, ""}, 1.0);
  rule.reversals = static_cast<int>(keys.integer("staircase", "reversals", 2, 500, 12));
  rule.discarded = static_cast<int>(keys.integer("staircase", "discarded_reversals", 0, 498, 4));
  if (rule.discarded + 2 > rule.reversals)
    keys.refuse("staircase", "discarded_reversals", "fewer than two reversals are left, discard fewer");
  rule.max_trials = static_cast<int>(keys.integer("staircase", "most_trials", 2, kMostTrials, 200));
  if (rule.kind == StepKind::ratio && !(*std::min_element(protocol.levels.begin(), protocol.levels.end()) > 0.0))
    keys.refuse("staircase", "start", "steps by ratio never leave zero, start above it");
}

}  // namespace

haptics::LawSettings Protocol::comparisonAt(double level) const {
  haptics::LawSettings law = comparison;
  if (!parameter.empty()) *parametersOf(law).at(parameter).value = level;
  return law;
}

std::optional<double> Protocol::standardValue() const {
  if (parameter.empty() || standard.kind != comparison.kind) return std::nullopt;
  haptics::LawSettings law = standard;
  return *parametersOf(law).at(parameter).value;
}

Protocol protocolFromToml(const std::string& text, const std::string& where) {
  assets::TomlReader keys(text, where);
  Protocol protocol;
  protocol.title = keys.text("", "title", "");
  protocol.participant = keys.text("", "participant");
  if (!isAnonymousId(protocol.participant))
    keys.refuse("", "participant",
                "give an anonymous id like P07: one to three capitals and up to four digits, never a name");
  protocol.method = static_cast<Method>(keys.choice("", "method", {"2afc-constant", "staircase", "2afc"}));
  protocol.bone = boneOf(keys);
  protocol.tool = toolOf(keys);
  protocol.probe = probeOf(keys);
  protocol.standard = lawOf(keys, "standard");
  protocol.comparison = lawOf(keys, "comparison");
  protocol.peak_force_N = keys.number("safety", "peak_force_N", {0.1, 40.0, "N"}, protocol.peak_force_N);
  if (protocol.method == Method::constant) readConstant(keys, protocol);
  if (protocol.method == Method::staircase) readStaircase(keys, protocol);
  if (protocol.method == Method::pair)
    protocol.trials = static_cast<int>(keys.integer("", "trials", 1, kMostTrials, 40));
  protocol.between_trials_s = keys.number("timing", "between_trials_s", {0.0, 600.0, "s"}, 1.0);
  protocol.observer.cue = static_cast<Cue>(keys.choice("observer", "cue", {"stiffness", "peak_force"}, 0));
  protocol.observer.weber_fraction = keys.number("observer", "weber_fraction", {0.0, 1.0, ""}, 0.15);
  protocol.observer.lapse_rate = keys.number("observer", "lapse_rate", {0.0, 0.5, ""}, 0.02);
  keys.refuseUnknownKeys();
  return protocol;
}

}  // namespace app
