#include "app/commands/compose_preparation.h"

#include <algorithm>
#include <span>
#include <utility>

#include "app/case/treated_tooth.h"
#include "app/options/tool_text.h"
#include "app/procedure/preparation/given_ideal.h"
#include "app/procedure/preparation/groove_script.h"
#include "app/procedure/preparation/preparation_script.h"
#include "app/procedure/root_canal/dense_tooth.h"
#include "app/text/usage_error.h"

namespace app {

std::string usualIdeal(const std::string& caries) {
  if (caries.empty()) return "crown:all-ceramic";
  return caries == "occlusal" ? "class-1" : "class-2:" + caries;
}

std::vector<std::string> preparationTools(const RehearseOptions& options) {
  const IdealRule* const rule = isIdealFile(options.ideal) ? nullptr : &idealRule(options.ideal, "--ideal");
  if (rule != nullptr && options.plan.device == "scripted") return scriptedBurs(*rule);
  // A pear and a narrow cylinder, a round one and an inverted cone, and what fills a cavity.
  if (rule != nullptr && rule->kind == IdealKind::cavity)
    return {"pear:0.5,1.2", "cylinder:0.4,4", "round:1.0",   "inverted-cone:0.5,0.8", "flame:0.6,6", "composite",
            "plugger",      "carver",         "curing-lamp", "glass-ionomer",         "amalgam",     "wax"};
  // A round-ended taper for walls and margin, a torpedo for a chamfer, a flame and a wheel for the biting surface.
  return {"round-taper:0.9,8", "torpedo:0.8,8", "flame:0.6,6", "wheel:1.8,1.2", "cylinder:0.5,6", "round:1.4"};
}

void planPreparation(RehearsalPlan& plan) {
  const assets::PreparedTooth& tooth = *plan.patient.prepared;
  if (tooth.given && plan.device == "scripted")
    throw UsageError("--device scripted: no hand knows the way to an ideal from a file, give mouse or poses:FILE.csv");
  if (tooth.given) return;
  const assets::CtVolume& ct = plan.patient.ct;
  Crown crown(ToothBlocks(DenseTooth(ct.grid, ct.solid, ct.label)), tooth.frame);
  const IdealRule& rule = idealRule(tooth.ideal, "--ideal");
  if (plan.device != "scripted") {
    PreparedIdeal(crown, rule, "--ideal");
    return;
  }
  std::vector<haptics::Tool> tray = plan.other_tools;
  tray.insert(tray.begin(), plan.command.tool);
  const std::vector<std::string> own = scriptedBurs(rule);
  const bool is_own = tray.size() >= own.size() &&
                      std::ranges::equal(
                          own, std::span(tray).first(own.size()), {},
                          [](const std::string& bur) { return toolFrom(bur, "").head; }, &haptics::Tool::head);
  plan.hand_script = is_own ? preparationScript({std::move(crown), rule, "--ideal"}, tray) : grooveScript(crown, tray);
}

std::vector<std::uint8_t> cutReady(assets::Patient& patient) {
  const assets::PreparedTooth& tooth = *patient.prepared;
  assets::CtVolume& ct = patient.ct;
  const PreparationMeasure measure(Crown(ToothBlocks(DenseTooth(ct.grid, ct.solid, ct.label)), tooth.frame), tooth,
                                   "--ideal");
  const BoxBytes& left = measure.ideal();
  std::vector<std::uint8_t> whole = ct.solid;
  const glm::ivec3 low(glm::round(ct.grid.indexFromPoint(left.grid().origin_P_mm)));
  assets::forVoxels(left.grid(), [&](glm::ivec3 ijk, std::size_t from) {
    const std::size_t v = ct.grid.index(low + ijk);
    if (left.bytes()[from] >= ct.solid[v]) return;
    ct.solid[v] = left.bytes()[from];
    ct.hounsfield[v] = greyOf(ct.solid[v], ct.label[v]);
  });
  return whole;
}

}  // namespace app
