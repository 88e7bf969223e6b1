#include "app/session/measures/untold.h"

#include <algorithm>
#include <span>

#include "app/session/measures/outcome.h"
#include "app/session/measures/zones.h"

namespace app {
namespace {

bool isOf(std::string_view id, std::initializer_list<std::string_view> beginnings) {
  return std::ranges::any_of(beginnings, [id](std::string_view one) { return id.starts_with(one); });
}

/// Of "S1.lingual_nerve_force": its lingual nerve.
std::optional<std::size_t> structureOf(std::string_view id) {
  std::optional<std::size_t> found;
  const std::string_view rest = id.substr(std::min(id.size(), id.find('.') + 1));
  for (std::size_t n = 0; n < assets::kRiskStructures; ++n) {
    const std::string_view key = assets::kRiskTexts[n].key;
    if (rest.starts_with(key) && (!found || key.size() > assets::kRiskTexts[*found].key.size())) found = n;
  }
  return found;
}

std::optional<std::string> whyNoOutcome(std::string_view id, const StoredStart& start, const SessionCase& about) {
  if (id != "O10.second_molar" && !isOf(id, {"O9.", "O11."}) && start.label.empty())
    return "the tissues of this case are not labelled";
  const bool is_of_zone = std::ranges::find(std::span(kZoneMeasures), id) != std::span(kZoneMeasures).end();
  if (is_of_zone && !zonesOfCase(start, about)) return "no operated tooth is known";
  if (isOf(id, {"O2.", "O3.", "O4."}) && !about.from_plan_mm) return std::string(about.why_no_plan);
  if (isOf(id, {"O7.", "O8."}) && !about.plan) return std::string(about.why_no_plan);
  if (isOf(id, {"O5.", "O6."}) && (about.risks.of(assets::RiskStructure::lingual).isEmpty() || !about.directions))
    return "the case has no lingual surface, or no operated tooth is known";
  if (isOf(id, {"O9.", "O11."}) && start.is_tooth.empty()) return "no tooth is a body of its own";
  const int fdi = start.setup.site ? start.setup.site->fdi - 1 : 0;
  if (id.starts_with("O10.") && (!start.setup.site || std::ranges::find(start.teeth, fdi) == start.teeth.end()))
    return "the case has no numbered second molar";
  return {};
}

}  // namespace

std::optional<std::string> whyNeverTold(std::string_view id, const StoredStart& start, const SessionCase& about) {
  // O1.removed is the tick's own.
  if (id.starts_with("O")) return id == "O1.removed" ? std::nullopt : whyNoOutcome(id, start, about);
  if (!isOf(id, {"S1.", "S2.", "S3.", "S4.", "S5."})) return {};
  const auto structure = structureOf(id);
  if (!structure || !about.risks.distance[*structure].isEmpty()) return {};
  return "the case has no " + std::string(assets::kRiskTexts[*structure].name);
}

}  // namespace app
