#include "app/case/extraction_plan.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <fmt/core.h>

#include "app/case/impaction_class.h"
#include "app/case/impaction_measures.h"
#include "app/case/root_form.h"
#include "app/text/usage_error.h"
#include "assets/tooth.h"

namespace app {
namespace {

constexpr double kContact_mm = 0.3;  ///< about a voxel
constexpr double kBuccoLingual_deg = 60.0;

PlanItem number(std::string_view key, std::string_view name, std::string_view unit, const Measured& measured,
                std::string how) {
  if (!measured.value) return {key, name, {}, unit, measured.missing};
  return {key, name, *measured.value, unit, std::move(how)};
}

void addAngle(const ImpactionMeasures& found, ExtractionPlan& plan) {
  plan.push_back(number("winter_angle", "angulation", "deg", found.angle_deg,
                        "long axes of third and second molar, normal to their cervical lines, in the sagittal plane of "
                        "the arch; positive: crown to mesial"));
  PlanItem named{"winter_class", "class after Winter", {}, "", found.angle_deg.missing};
  if (std::abs(*found.across_deg.value) > kBuccoLingual_deg) {
    named.value = *found.across_deg.value > 0.0 ? "bucco-angular" : "linguo-angular";
    named.how = "the crown points across the arch";
  } else if (found.angle_deg.value) {
    named.value = std::string(nameOf(winterClass(*found.angle_deg.value)));
    named.how = "vertical from -10 to 10°, mesio-angular to 79, horizontal to 100, disto-angular to -79";
  }
  plan.push_back(std::move(named));
}

void addDepthAndRamus(const ImpactionMeasures& found, ExtractionPlan& plan) {
  plan.push_back(number("depth", "depth", "mm", found.depth_mm,
                        "highest point under the second molar's, along the second molar's axis"));
  PlanItem depth{"pell_gregory_depth", "depth, Pell and Gregory", {}, "", found.depth_mm.missing};
  if (depth.how.empty()) depth.how = found.cervical_line_mm.missing;
  if (found.depth_mm.value && found.cervical_line_mm.value) {
    depth.value = std::string(1, pellGregoryDepth(*found.depth_mm.value, *found.cervical_line_mm.value));
    depth.how = fmt::format("A level with the second molar, C below its cervical line, which lies {:.1f} mm down",
                            *found.cervical_line_mm.value);
  }
  plan.push_back(std::move(depth));
  PlanItem ramus{"pell_gregory_ramus", "ramus, Pell and Gregory", {}, "", found.covered_share.missing};
  if (found.covered_share.value) {
    ramus.value = std::string(ramusClassName(pellGregoryRamus(*found.covered_share.value)));
    ramus.how = fmt::format("no room before the ramus for {:.0f} % of the crown's mesiodistal diameter",
                            100.0 * *found.covered_share.value);
  }
  plan.push_back(std::move(ramus));
}

void addCanal(const ImpactionMeasures& found, ExtractionPlan& plan) {
  plan.push_back(
      number("canal_distance", "canal", "mm", found.canal_mm, "third molar to the canal's wall, nearest points"));
  PlanItem relation{"canal_relation", "canal's place", {}, "", found.canal_mm.missing};
  if (found.canal_mm.value) {
    constexpr std::string_view kPlaces[] = {"below the roots", "buccal of the roots", "lingual of the roots",
                                            "between the roots"};
    relation.value = fmt::format("{}, {}", kPlaces[static_cast<std::size_t>(found.canal_place)],
                                 *found.canal_mm.value <= kContact_mm ? "in contact" : "apart");
    relation.how = "where the two are nearest";
  }
  plan.push_back(std::move(relation));
}

void addRoots(const std::optional<RootForm>& form, ExtractionPlan& plan) {
  PlanItem count{"roots", "roots", {}, "", "less than 3 mm of root, or no labelled enamel to find the cervical line"};
  PlanItem shape{"root_shape", "their shape", {}, "", count.how};
  if (form) {
    constexpr double kStraight_deg = 10.0, kParallel_mm = 1.0;
    count.value = static_cast<double>(form->count);
    count.how = form->count == 1 ? fmt::format("one, or fused, over its length of {:.0f} mm", form->length_mm)
                                 : fmt::format("apart from {:.0f} mm below the cervical line, {:.0f} mm long",
                                               form->furcation_mm, form->length_mm);
    std::string words = form->count == 1                  ? "single or fused"
                        : form->spread_mm > kParallel_mm  ? "diverging"
                        : form->spread_mm < -kParallel_mm ? "converging"
                                                          : "parallel";
    if (std::abs(form->bend_deg) > kStraight_deg)
      words +=
          fmt::format(", bent {:.0f}° to {}", std::abs(form->bend_deg), form->bend_deg > 0.0 ? "distal" : "mesial");
    shape.value = std::move(words);
    shape.how = form->count == 1 ? "middle line of the root against the long axis"
                                 : fmt::format(
                                       "distance of the ends less that at the furcation {:+.1f} mm; middle "
                                       "lines against the long axis",
                                       form->spread_mm);
  }
  plan.push_back(std::move(count));
  plan.push_back(std::move(shape));
}

void addDifficulty(const ImpactionMeasures& found, ExtractionPlan& plan) {
  PlanItem index{"difficulty", "difficulty", {}, "of 10", ""};
  for (const Measured* one : {&found.angle_deg, &found.depth_mm, &found.cervical_line_mm, &found.covered_share})
    if (!one->value && index.how.empty()) index.how = one->missing;
  const bool across = std::abs(*found.across_deg.value) > kBuccoLingual_deg;
  if (index.how.empty()) {
    const int sum = across ? 0
                           : pedersonSum(winterClass(*found.angle_deg.value),
                                         pellGregoryDepth(*found.depth_mm.value, *found.cervical_line_mm.value),
                                         pellGregoryRamus(*found.covered_share.value));
    if (sum == 0) {
      index.how = "Pederson's index has no value for an inverted or transverse tooth";
    } else {
      index.value = static_cast<double>(sum);
      index.how =
          fmt::format("{} after Pederson: angulation, depth and ramus; to 4 slight, to 6 moderate", pedersonWord(sum));
    }
  }
  plan.push_back(std::move(index));
}

}  // namespace

ExtractionPlan extractionPlan(const assets::Patient& patient, const std::string& name) {
  if (!patient.site)
    throw UsageError(name + ": no third molar is labelled here, import it with teeth.nrrd or molar import --tooth");
  const int fdi = patient.site->fdi;
  if (!assets::isThirdMolar(fdi) || assets::isUpper(fdi))
    throw UsageError(
        fmt::format("{}: the operated tooth is {}, give a patient with a lower third molar, 38 or 48", name, fdi));
  const ToothVoxels third = toothVoxels(toothAlone(patient.ct, fdi), fdi);
  if (third.all_P_mm.empty())
    throw UsageError(fmt::format("{}: no voxel is labelled as tooth {}, see molar inspect", name, fdi));

  const ImpactionMeasures found = measureImpaction(patient, third);
  ExtractionPlan plan;
  plan.push_back({"fdi", "tooth", static_cast<double>(fdi), "FDI", assets::toothName(fdi)});
  addAngle(found, plan);
  addDepthAndRamus(found, plan);
  addCanal(found, plan);
  const ArchFrame frame = archFrame(patient);
  plan.push_back(number("lingual_plate", "lingual plate", "mm", found.lingual_plate_mm,
                        "bone lingual of the roots where it is thinnest, from 2.5 mm below the cervical line; 0: open "
                        "before surgery"));
  plan.push_back(number("second_molar", "second molar", "mm", found.second_molar_mm,
                        fmt::format("distance to tooth {}, nearest points", fdi - 1)));
  addRoots(rootForm(third, patient.site->axis_P, frame.mesialSideOf(patient.site->axis_P), patient.ct.grid.spacing_mm),
           plan);
  addDifficulty(found, plan);
  const assets::Proposed proposed = patient.proposed();
  for (PlanItem& item : plan)
    item.is_confirmed = !item.isKnown() || !(proposed.tooth || (proposed.canal && item.key.starts_with("canal")));
  return plan;
}

const PlanItem& itemOf(const ExtractionPlan& plan, std::string_view key) {
  const auto found = std::ranges::find(plan, key, &PlanItem::key);
  assert(found != plan.end());
  return *found;
}

std::string valueText(const PlanItem& item) {
  if (const auto* words = std::get_if<std::string>(&item.value)) return *words;
  const auto* figure = std::get_if<double>(&item.value);
  if (figure == nullptr) return "not known";
  const bool is_measured = item.unit == "mm" || item.unit == "deg";
  std::string text = fmt::format("{:.{}f} {}", *figure, is_measured ? 1 : 0, item.unit == "deg" ? "°" : item.unit);
  if (text.back() == ' ') text.pop_back();
  return text;
}

std::string planTable(const ExtractionPlan& plan) {
  std::string text;
  for (const PlanItem& item : plan)
    text += fmt::format("{:<24} {:<28} {}{}\n", item.name, valueText(item), item.is_confirmed ? "" : "not confirmed; ",
                        item.how);
  return text;
}

}  // namespace app
