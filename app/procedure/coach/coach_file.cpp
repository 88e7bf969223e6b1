#include "app/procedure/coach/coach_file.h"

#include <algorithm>

#include "app/text/list.h"
#include "app/text/usage_error.h"
#include "assets/toml_reader.h"

namespace app {
namespace {

struct ShippedRules {
  std::string_view name, text;
};
constexpr ShippedRules kShippedRules[] = {
#include "shipped_coach.inc"
};

constexpr std::size_t kMostRules = 20, kLongestSaying = 80;

CoachRule ruleOf(assets::TomlReader& keys, const std::string& table) {
  CoachRule rule;
  const std::string sign = keys.text(table, "looks_for");
  const auto found = std::ranges::find(kCoachSigns, sign);
  if (found == kCoachSigns.end()) keys.refuse(table, "looks_for", "no such sign, give one of " + joined(kCoachSigns));
  rule.looks_for = static_cast<CoachSign>(found - kCoachSigns.begin());
  const bool is_ratio = rule.looks_for == CoachSign::plunging || rule.looks_for == CoachSign::deep_stroke;
  const bool is_near = rule.looks_for == CoachSign::near_structure;
  if (is_near) rule.within_mm = keys.number(table, "within_mm", {0.1, 10.0, "mm"});
  if (rule.looks_for == CoachSign::force || is_near) rule.most = keys.number(table, "most", {0.1, 100.0, "N"});
  if (is_ratio) rule.most = keys.number(table, "most", {0.05, 10.0, ""});
  if (!is_ratio) rule.for_s = keys.number(table, "for_s", {0.0, 60.0, "s"});
  rule.says = keys.text(table, "says");
  if (rule.says.empty() || rule.says.size() > kLongestSaying)
    keys.refuse(table, "says", "give 1 to " + std::to_string(kLongestSaying) + " bytes of text in quotes");
  return rule;
}

}  // namespace

std::string shippedCoachText() { return std::string(kShippedRules[0].text); }

CoachRules coachRulesFromToml(const std::string& text, const std::string& where) {
  assets::TomlReader keys(text, where);
  CoachRules rules;
  rules.pause_s = keys.number("", "pause_s", {1.0, 60.0, "s"}, rules.pause_s);
  rules.again_s = keys.number("", "again_s", {1.0, 600.0, "s"}, rules.again_s);
  const std::size_t count = keys.tables("rule", 1, kMostRules);
  for (std::size_t n = 1; n <= count; ++n) rules.rules.push_back(ruleOf(keys, "rule." + std::to_string(n)));
  keys.refuseUnknownKeys();
  return rules;
}

CoachRules coachRulesOf(const std::string& file) {
  if (file.empty()) return coachRulesFromToml(shippedCoachText(), "coach_rules.toml");
  if (!file.ends_with(".toml")) throw UsageError("--coach " + file + ": give on, off or a FILE.toml of rules");
  return coachRulesFromToml(assets::readSmallFile(file), file);
}

}  // namespace app
