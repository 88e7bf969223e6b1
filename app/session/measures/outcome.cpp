#include "app/session/measures/outcome.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <span>

#include <fmt/core.h>

#include "app/session/measures/perforation.h"
#include "app/session/measures/plan_comparison.h"
#include "app/session/measures/section_left.h"
#include "app/session/measures/trough.h"
#include "app/session/measures/zones.h"
#include "assets/tissue.h"
#include "assets/tooth.h"

namespace app {
namespace {

constexpr std::string_view kNothingGone = "no bone was removed";

constexpr std::array kOutcomes = std::to_array<MeasureName>({
    {"O1.bone", "bone removed", "mm3"},
    {"O1.tooth", "tooth removed by the bur", "mm3"},
    {"O1.occlusal", "bone removed above the tooth", "mm3"},
    {"O1.buccal", "bone removed on the cheek's side", "mm3"},
    {"O1.distal", "bone removed behind the tooth", "mm3"},
    {"O1.mesial", "bone removed before the tooth", "mm3"},
    {"O1.lingual", "bone removed on the tongue's side", "mm3"},
    {"O1.apical", "bone removed below the tooth", "mm3"},
    {"O2.plan", "share of the planned bone that is gone", ""},
    {"O3.planned", "bone planned to go", "mm3"},
    {"O3.over", "bone removed outside of the plan", "mm3"},
    {"O3.under", "bone of the plan that stands", "mm3"},
    {"O3.dice", "overlap with the plan (Dice)", ""},
    {"O4.mean", "how far outside of the plan, mean", "mm"},
    {"O4.p95", "how far outside of the plan, 95 %", "mm"},
    {"O4.max", "how far outside of the plan, most", "mm"},
    {"O5.count", "perforations of the outer lingual surface", ""},
    {"O5.area", "area of these perforations", "mm2"},
    {"O6.wall", "least bone left before the outer lingual surface", "mm"},
    {"O7.depth", "depth of the trough, mean of stations", "mm"},
    {"O7.depth_cv", "unevenness of its depth (CV)", ""},
    {"O7.width", "width of the trough, mean of stations", "mm"},
    {"O7.width_cv", "unevenness of its width (CV)", ""},
    {"O7.section", "section of the trough, mean of stations", "mm2"},
    {"O7.length", "length of the trough", "mm"},
    {"O8.gouges", "gouges: more than 0.5 mm below the floor around", ""},
    {"O8.deepest", "deepest gouge", "mm"},
    {"O9.bridge", "thickness of the tooth's bridge when it came apart, or at the end", "mm"},
    {"O9.area", "area of that bridge", "mm2"},
    {"O10.second_molar", "removed of the second molar", "mm3"},
    {"O11.count", "parts of the tooth left in", ""},
    {"O11.volume", "tooth left in", "mm3"},
});

class Outcome {
 public:
  explicit Outcome(const OutcomeOf& of) : of_(of), values_(untold(kOutcomes, "")) {}

  std::vector<MeasureValue> values() {
    if (isWanted("O1.")) removed();
    if (isWanted("O2.") || isWanted("O3.") || isWanted("O4.")) againstPlan();
    if (isWanted("O5.") || isWanted("O6.")) lingual();
    if (isWanted("O7.") || isWanted("O8.")) trough();
    if (isWanted("O9.")) section();
    if (isWanted("O10.")) secondMolar();
    if (isWanted("O11.")) leftIn();
    for (MeasureValue& value : values_)
      if (value.value) value.conditions = fmt::format("voxel {:g} mm", of_.start.grid.spacing_mm);
    return std::move(values_);
  }

 private:
  bool isWanted(std::string_view beginning) const {
    return of_.wanted.empty() ||
           std::ranges::any_of(of_.wanted, [&](const std::string& id) { return id.starts_with(beginning); });
  }
  MeasureValue& named(std::string_view id) { return *std::ranges::find(values_, id, &MeasureValue::id); }
  void tell(std::string_view id, std::optional<double> value, std::string_view why = {},
            std::optional<double> t_s = {}) {
    MeasureValue& one = named(id);
    one.value = value, one.t_s = t_s;
    if (!value) one.why = why;
  }
  void refuse(std::span<const std::string_view> ids, std::string_view why) {
    for (const std::string_view id : ids) tell(id, {}, why);
  }
  void refuse(std::initializer_list<std::string_view> ids, std::string_view why) {
    for (const std::string_view id : ids) tell(id, {}, why);
  }
  bool isBone(std::size_t v) const { return countsAsBone(of_.start.label[v]); }
  bool isLabelled() const { return !of_.start.label.empty(); }

  /// By zone in the order of Zone.
  void removed() {
    constexpr std::span kIds = kZoneMeasures;
    const StoredStart& start = of_.start;
    if (!isLabelled()) {
      refuse({"O1.bone", "O1.tooth"}, "tissues are not labelled");
      return refuse(kIds, "tissues are not labelled");
    }
    const std::optional<Zones> zones = zonesOfCase(start, of_.about);
    const double voxel_mm3 = start.grid.voxelVolume_mm3();
    double bone_mm3 = 0.0, tooth_mm3 = 0.0;
    std::array<double, kZones> by_zone_mm3{};
    for (const RemovedVoxel& voxel : of_.clock.removed()) {
      const double mm3 = voxel.share * voxel_mm3;
      // What was taken out in one piece was not removed by the bur.
      if (assets::isTooth(start.label[voxel.index]) && voxel.t_s) tooth_mm3 += mm3;
      if (!isBone(voxel.index)) continue;
      bone_mm3 += mm3;
      if (zones) by_zone_mm3[static_cast<std::size_t>(zones->at(start.grid.centre_P_mm(voxel.ijk)))] += mm3;
    }
    tell("O1.bone", bone_mm3);
    if (of_.removed_mm3) {
      tooth_mm3 = 0.0;
      for (const assets::TissueProperties& tissue : assets::kTissues)
        if (const auto found = of_.removed_mm3->find(std::string(tissue.key));
            tissue.tooth && found != of_.removed_mm3->end())
          tooth_mm3 += found->second;
    }
    tell("O1.tooth", tooth_mm3);
    if (!zones) return refuse(kIds, "no operated tooth is known");
    for (std::size_t n = 0; n < kZones; ++n) tell(kIds[n], by_zone_mm3[n]);
  }

  void againstPlan() {
    const auto ids = {std::string_view("O2.plan"),  std::string_view("O3.planned"), std::string_view("O3.over"),
                      std::string_view("O3.under"), std::string_view("O3.dice"),    std::string_view("O4.mean"),
                      std::string_view("O4.p95"),   std::string_view("O4.max")};
    if (!of_.about.from_plan_mm || !isLabelled()) return refuse(ids, of_.about.why_no_plan);
    const PlanComparison found = compareWithPlan(
        of_.start.grid, of_.start.solid, of_.after, [this](std::size_t v) { return isBone(v); },
        of_.about.from_plan_mm);
    if (!(found.planned_mm3 > 0.0)) return refuse(ids, "there is no bone in the plan");
    tell("O2.plan", found.both_mm3 / found.planned_mm3);
    tell("O3.planned", found.planned_mm3);
    tell("O3.over", found.over_mm3());
    tell("O3.under", found.under_mm3());
    tell("O3.dice", found.dice());
    constexpr std::string_view kNone = "no bone was cut outside of the plan";
    tell("O4.mean", found.over_mean_mm, kNone);
    tell("O4.p95", found.over_p95_mm, kNone);
    tell("O4.max", found.over_max_mm, kNone);
  }

  void lingual() {
    const assets::StructureDistance& beyond = of_.about.risks.of(assets::RiskStructure::lingual);
    if (beyond.isEmpty() || !of_.about.directions || !isLabelled())
      return refuse({"O5.count", "O5.area", "O6.wall"},
                    "the case has no lingual surface, or no operated tooth is known");
    const RemovedBone bone{of_.clock, of_.start.label, of_.start.solid, of_.after};
    const std::vector<Hole> holes = perforations(bone, beyond, -of_.about.directions->buccal_P);
    double area_mm2 = 0.0;
    std::optional<double> first_s;
    for (const Hole& hole : holes) {
      area_mm2 += hole.area_mm2;
      if (hole.first_s && (!first_s || *hole.first_s < *first_s)) first_s = hole.first_s;
    }
    tell("O5.count", static_cast<double>(holes.size()), {}, first_s);
    tell("O5.area", area_mm2, {}, first_s);
    tell("O6.wall", wallLeft_mm(bone, beyond), kNothingGone);
  }

  void trough() {
    const auto profile_ids = {std::string_view("O7.depth"),   std::string_view("O7.depth_cv"),
                              std::string_view("O7.width"),   std::string_view("O7.width_cv"),
                              std::string_view("O7.section"), std::string_view("O7.length")};
    const auto gouge_ids = {std::string_view("O8.gouges"), std::string_view("O8.deepest")};
    if (!of_.about.plan || !isLabelled() || of_.surface == nullptr) {
      refuse(profile_ids, of_.about.why_no_plan);
      return refuse(gouge_ids, of_.about.why_no_plan);
    }
    const assets::PlannedCut& plan = *of_.about.plan;
    CutAxes axes;
    axes.outward_P = glm::normalize(plan.outward_P);
    axes.along_P = glm::normalize(glm::cross(plan.outward_P, plan.lateral_P));
    axes.across_P = glm::cross(axes.along_P, axes.outward_P);
    const auto counts = [this](std::size_t v) { return isBone(v); };
    const auto profile =
        troughProfile(of_.clock, axes, counts, [this](const glm::dvec3& p) { return -of_.surface->distance_mm(p); });
    if (profile) {
      tell("O7.depth", profile->depth_mm.mean), tell("O7.depth_cv", profile->depth_mm.variation);
      tell("O7.width", profile->width_mm.mean), tell("O7.width_cv", profile->width_mm.variation);
      tell("O7.section", profile->section_mm2), tell("O7.length", profile->length_mm);
    } else {
      refuse(profile_ids, "no trough of three stations was cut");
    }
    if (const auto gouges = gougesIn(of_.clock, axes, counts))
      tell("O8.gouges", gouges->count), tell("O8.deepest", gouges->deepest_mm);
    else
      refuse(gouge_ids, kNothingGone);
  }

  void section() {
    if (of_.start.is_tooth.empty()) return refuse({"O9.bridge", "O9.area"}, "no tooth is a body of its own");
    const auto left = sectionLeft(of_.clock, of_.start.solid, of_.after, of_.start.is_tooth, of_.parted_s);
    if (!left) return refuse({"O9.bridge", "O9.area"}, "the tooth was not cut to a bridge");
    tell("O9.bridge", left->thickness_mm, {}, of_.parted_s);
    tell("O9.area", left->area_mm2, {}, of_.parted_s);
  }

  void secondMolar() {
    const StoredStart& start = of_.start;
    const int fdi = start.setup.site ? start.setup.site->fdi - 1 : 0;
    if (start.teeth.empty() || !start.setup.site || std::ranges::find(start.teeth, fdi) == start.teeth.end())
      return tell("O10.second_molar", {}, "the second molar is not numbered in this recording");
    double removed = 0.0;
    std::optional<double> first_s;
    for (const RemovedVoxel& voxel : of_.clock.removed()) {
      if (start.teeth[voxel.index] != fdi) continue;
      removed += voxel.share;
      if (voxel.t_s && (!first_s || *voxel.t_s < *first_s)) first_s = voxel.t_s;
    }
    tell("O10.second_molar", removed * start.grid.voxelVolume_mm3(), {}, first_s);
  }

  void leftIn() {
    if (!of_.socket || !of_.socket->is_out)
      return refuse({"O11.count", "O11.volume"}, "no piece of the tooth was out at the end");
    tell("O11.count", static_cast<double>(of_.socket->retained.size()));
    tell("O11.volume", sumOf(of_.socket->retained));
  }

  const OutcomeOf& of_;
  std::vector<MeasureValue> values_;
};

}  // namespace

std::span<const MeasureName> outcomeNames() { return kOutcomes; }

std::vector<MeasureValue> outcomeMeasures(const OutcomeOf& of) { return Outcome(of).values(); }

std::vector<MeasureValue> noOutcome(std::string_view why) { return untold(kOutcomes, why); }

}  // namespace app
