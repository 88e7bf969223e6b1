#include "app/commands/compose_preparation.h"

#include <cmath>
#include <utility>

#include "app/case/treated_tooth.h"
#include "app/procedure/preparation/bite.h"
#include "app/procedure/preparation/given_antagonist.h"
#include "app/procedure/preparation/given_ideal.h"
#include "app/procedure/preparation/groove_script.h"
#include "app/procedure/preparation/preparation_paint.h"
#include "app/procedure/preparation/preparation_script.h"
#include "app/procedure/root_canal/dense_tooth.h"
#include "app/text/list.h"
#include "app/text/parse_number.h"
#include "app/text/usage_error.h"

namespace app {

std::string usualIdeal(const std::string& caries) {
  if (caries.empty()) return "crown:all-ceramic";
  return caries == "occlusal" ? "class-1" : "class-2:" + caries;
}

glm::dvec2 hingeFrom(const std::string& text) {
  constexpr double kMost_mm = 200.0, kLeastBehind_mm = 10.0;
  const std::vector<std::string_view> words = split(text);
  const auto behind_mm = parseNumber<double>(words.front()), over_mm = parseNumber<double>(words.back());
  if (words.size() != 2 || !behind_mm || !over_mm || !(*behind_mm >= kLeastBehind_mm && *behind_mm <= kMost_mm) ||
      !(std::abs(*over_mm) <= kMost_mm))
    throw UsageError("--hinge " + text +
                     ": give BACK,UP, mm behind the tooth (10 to 200) and over its bite (-200 to 200), as in 55,32");
  return {*behind_mm, *over_mm};
}

std::vector<std::string> chooseBite(assets::Patient& patient, const assets::CtVolume& whole,
                                    const RehearseOptions& options) {
  assets::PreparedTooth& tooth = *patient.prepared;
  std::vector<std::string> remarks;
  if (options.former_bite) tooth.bite = *options.former_bite;
  tooth.opposing = options.opposing;
  const bool is_scanned = options.antagonist.empty() && !tooth.opposing && hasOpposingTeeth(whole, tooth.fdi);
  const bool is_asked = !options.antagonist.empty() || !options.bite.empty() || !options.hinge.empty();
  if (!is_scanned && !is_asked) return remarks;
  const Crown crown(ToothBlocks(DenseTooth(patient.ct.grid, patient.ct.solid, patient.ct.label)), tooth.frame);
  std::optional<GivenAntagonist> given;
  if (!options.antagonist.empty()) given = readAntagonist(options.antagonist, crown, "--antagonist");
  if (is_scanned) given = scannedAntagonist(whole, tooth.fdi, crown);
  if (given) {
    if (!given->remark.empty()) remarks.push_back(given->remark);
    tooth.bite.closing = given->is_arch ? assets::Closing::hinge : assets::Closing::axis;
    tooth.opposing = std::move(given->teeth);
  } else if (is_scanned) {
    remarks.push_back("the scan's opposing teeth do not stand over tooth " + std::to_string(tooth.fdi) +
                      ": one is made");
  }
  for (const auto closing : {assets::Closing::axis, assets::Closing::hinge, assets::Closing::balance})
    if (options.bite == nameOf(closing)) tooth.bite.closing = closing;
  if (!options.former_bite || !options.hinge.empty() || tooth.bite.hinge_P_mm == glm::dvec3(0.0))
    tooth.bite.hinge_P_mm =
        hinge_P_mm(crown, options.hinge.empty() ? usualHinge_mm(tooth.fdi) : hingeFrom(options.hinge));
  return remarks;
}

std::vector<std::string> preparationTools(const RehearseOptions& options) {
  const IdealRule* const rule = isIdealFile(options.ideal) ? nullptr : &idealRule(options.ideal, "--ideal");
  if (options.plan.device == "scripted") return scriptedBurs(rule);
  // A pear and a narrow cylinder, a round one and an inverted cone, and what fills a cavity.
  if (rule != nullptr && rule->kind == IdealKind::cavity)
    return {"pear:0.5,1.2", "cylinder:0.4,4", "round:1.0",   "inverted-cone:0.5,0.8", "flame:0.6,6", "composite",
            "plugger",      "carver",         "curing-lamp", "glass-ionomer",         "amalgam",     "wax"};
  // A round-ended taper for walls and margin, a torpedo for a chamfer, a flame and a wheel for the biting surface.
  return {"round-taper:0.9,8", "torpedo:0.8,8", "flame:0.6,6", "wheel:1.8,1.2", "cylinder:0.5,6", "round:1.4"};
}

void planPreparation(RehearsalPlan& plan, bool draws_outline, bool grooves) {
  const assets::PreparedTooth& tooth = *plan.patient.prepared;
  const bool is_scripted = plan.device == "scripted";
  if (tooth.given && !is_scripted) return;
  const assets::CtVolume& ct = plan.patient.ct;
  Crown crown(ToothBlocks(DenseTooth(ct.grid, ct.solid, ct.label)), tooth.frame);
  if (!tooth.given) {
    const PreparedIdeal ideal(crown, idealRule(tooth.ideal, "--ideal"), "--ideal");
    if (draws_outline) plan.outline = {crown.solid.grid(), outlineSpots(crown, ideal)};
  }
  if (!is_scripted) return;
  std::vector<haptics::Tool> tray = plan.other_tools;
  tray.insert(tray.begin(), plan.command.tool);
  if (grooves) {
    plan.hand_script = grooveScript(crown, tray);
    return;
  }
  const PreparationMeasure measure(std::move(crown), tooth, "--ideal");
  plan.hand_script = preparationScript(measure, tray);
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
