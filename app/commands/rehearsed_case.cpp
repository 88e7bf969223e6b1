#include "app/commands/rehearsed_case.h"

#include <algorithm>
#include <future>

#include "app/case/case.h"
#include "app/case/clearance_source.h"
#include "app/case/closed_gum.h"
#include "app/case/extraction_plan.h"
#include "app/case/handpiece_direction.h"
#include "app/case/impaction_class.h"
#include "app/case/patient_source.h"
#include "app/case/prepared_tooth.h"
#include "app/case/soft_tissue_source.h"
#include "app/case/treated_tooth.h"
#include "app/case/trough_plan.h"
#include "app/commands/compose_preparation.h"
#include "app/controls/prediction_question.h"
#include "app/device/pose_source_table.h"
#include "app/procedure/preparation/given_ideal.h"
#include "app/procedure/root_canal/dense_tooth.h"
#include "app/rehearsal/live_view.h"
#include "app/text/message.h"
#include "app/text/usage_error.h"
#include "app/view/preparation.h"
#include "assets/patient/patient_folder.h"
#include "assets/tooth.h"

namespace app {
namespace {

struct PreparedCase {
  assets::Patient patient;
  assets::FacePose X_PF = assets::kFaceAxes_PF;
  std::optional<CutPlan> cut;
  assets::SoftTissueField soft_tissue;
  assets::RiskStructures risks;
  Prediction computed;  ///< difficulty and index alone
  std::vector<std::string> remarks;
};

/// Nothing where they cannot be measured.
Prediction computedDifficulty(const assets::Patient& patient) {
  Prediction computed;
  try {
    const PlanItem index = itemOf(extractionPlan(patient, "PATIENT"), "difficulty");
    if (const double* const sum = std::get_if<double>(&index.value)) {
      computed.index = *sum;
      computed.computed = kDifficulties[pedersonGrade(static_cast<int>(*sum))];
    }
  } catch (const UsageError&) {
  }
  return computed;
}

/// By rule, or of a file.
void takeIdeal(assets::Patient& patient, const RehearseOptions& options) {
  assets::PreparedTooth& tooth = *patient.prepared;
  const bool is_given = isIdealFile(options.ideal) || options.given_ideal;
  tooth.ideal = is_given ? assets::kGivenIdeal : options.ideal;
  if (!is_given) return;
  const Crown crown(ToothBlocks(DenseTooth(patient.ct.grid, patient.ct.solid, patient.ct.label)), tooth.frame);
  tooth.given = options.given_ideal ? *options.given_ideal : readGivenIdeal(options.ideal, crown, "--ideal");
}

/// The patient, and what is computed from it: the cut and how a handpiece lies clear of soft tissue while it is made.
PreparedCase prepared(const RehearseOptions& options, const assets::JawParameters& jaw, const haptics::Tool& tool,
                      const assets::ReportProgress& report) {
  PreparedCase one;
  constexpr double kPatientShare = 0.75, kSoftTissueShare = 0.9;
  const auto load = assets::sectionOf(report, 0.0, kPatientShare);
  if (const auto task = practiceOf(options)) {
    static const RehearseOptions kAsked;
    one.patient = options.jaw.spacing_mm == kAsked.jaw.spacing_mm
                      ? assets::practiceBlock(*task)
                      : assets::practiceBlock(*task, options.jaw.spacing_mm);
    one.cut = CutPlan{assets::practiceCut(*task, tool.head.radius_mm), CutKind::gutter};
    one.cut->cut.shaft_P = one.cut->cut.outward_P;
    return one;
  }
  if (const auto* const block = preparationBlockOf(options)) {
    one.patient = assets::preparationBlock(*block);
    takeIdeal(one.patient, options);
    one.remarks = chooseBite(one.patient, {}, options);
    return one;
  }
  one.patient = options.patient.empty() ? builtInPatient(jaw, load) : assets::loadPatient(options.patient, load);
  one.X_PF = one.patient.X_PF.value_or(assets::kFaceAxes_PF);
  if (!options.face.empty()) one.X_PF = replaceFace(one.patient, options.face);
  // The dam keeps lip, cheek and tongue away.
  if (isRootCanal(options)) {
    const auto built_in = options.patient.empty() ? std::optional(jaw) : std::nullopt;
    one.patient = treatedTooth(one.patient, built_in, *options.tooth, options.access == "open", "--tooth");
    return one;
  }
  if (isPreparation(options)) {
    const auto built_in = options.patient.empty() ? std::optional(jaw) : std::nullopt;
    // A straight handpiece held upright would press lip and cheek all the time, where a
    // dentist's is bent: they are held away.
    const bool is_given = isIdealFile(options.ideal) || options.given_ideal;
    const assets::Patient whole = std::move(one.patient);
    one.patient = preparedTooth(whole, built_in, *options.tooth,
                                {is_given ? assets::kGivenIdeal : options.ideal, options.caries}, "--tooth");
    one.remarks = chooseBite(one.patient, whole.ct, options);
    takeIdeal(one.patient, options);
    return one;
  }
  if (options.flap == "closed") {
    auto gum = closedGum(one.patient);
    if (!gum)
      throw UsageError("--flap " + options.flap +
                       ": no gum is labelled over a planned cut in this patient, leave it out");
    one.patient.gingiva = std::move(*gum);
  }
  auto cut = std::async(std::launch::async, [&] { return plannedCut(one.patient, tool.head.radius_mm); });
  auto computed = std::async(std::launch::async, [&] {
    const std::optional<ProcedureSteps>& steps = options.plan.procedure_steps;
    const bool compares = steps && (steps->asks || steps->prediction.isGiven());
    return compares ? computedDifficulty(one.patient) : Prediction{};
  });
  auto risks = std::async(std::launch::async, [&] { return cachedRiskStructures(one.patient); });
  const assets::SoftTissueRegion region{one.patient.focus_P_mm()};
  one.soft_tissue = softTissueAround(one.patient.gingiva, one.patient.face, region);
  report(kSoftTissueShare);
  one.computed = computed.get();
  one.risks = risks.get();
  one.cut = cut.get();
  if (one.cut) one.cut->cut.shaft_P = handpieceDirection_P(one.cut->cut, one.patient.ct, one.soft_tissue, tool);
  return one;
}

}  // namespace

std::optional<assets::PracticeTask> practiceOf(const RehearseOptions& options) {
  return assets::practiceTaskOf(options.case_name);
}

const assets::PreparationBlock* preparationBlockOf(const RehearseOptions& options) {
  return assets::preparationBlockOf(options.case_name);
}
bool isOnBlock(const RehearseOptions& options) { return practiceOf(options) || preparationBlockOf(options) != nullptr; }

bool isRootCanal(const RehearseOptions& options) { return options.task == "root-canal"; }
bool isPreparation(const RehearseOptions& options) { return options.task == "preparation"; }

assets::JawParameters jawOf(const RehearseOptions& options) {
  assets::JawParameters jaw = options.jaw;
  // The jaw has the teeth of one side: that of the tooth that is asked for.
  jaw.right_side =
      options.task != "extraction" && options.tooth ? assets::isRight(*options.tooth) : options.side == "right";
  if (options.case_name.empty() || isOnBlock(options)) return jaw;
  jaw = caseNamed(options.case_name)->jaw;
  jaw.spacing_mm = options.jaw.spacing_mm;
  jaw.seed = options.jaw.seed;
  return jaw;
}

bool prepareCase(RehearsalPlan& plan, const RehearseOptions& options, const assets::JawParameters& jaw,
                 assets::FacePose& X_PF) {
  const SurgeonDisplay::Options shown = displayOf(plan);
  Preparation preparation({.windows = shown.windows,
                           .eyes_swapped = shown.eyes_swapped,
                           .headless = plan.headless,
                           .needs_window = shown.needs_window},
                          plan.rig, "Preparing the patient", printMessage);
  auto one = preparation.run<PreparedCase>(
      [&](const assets::ReportProgress& report) { return prepared(options, jaw, plan.command.tool, report); });
  if (!one) return false;
  plan.patient = std::move(one->patient);
  plan.soft_tissue = std::move(one->soft_tissue);
  plan.risks = std::move(one->risks);
  plan.remarks.insert(plan.remarks.end(), one->remarks.begin(), one->remarks.end());
  plan.windows = preparation.takeWindows();
  if (plan.procedure_steps) {
    plan.procedure_steps->prediction.computed = one->computed.computed;
    plan.procedure_steps->prediction.index = one->computed.index;
  }
  X_PF = one->X_PF;
  if (!one->cut) return true;
  plan.cut = one->cut->cut;
  const PoseSourceKind* const hand = poseSourceKindOf(plan.device);
  if (one->cut->kind == CutKind::nearest_bone && hand && hand->follows_plan)
    printMessage((plan.patient.site ? "no gutter fits beside the " + assets::toothName(plan.patient.site->fdi)
                                    : std::string("no operated tooth is labelled")) +
                 ", the scripted cut is on the nearest bone");
  return true;
}

void closeFlap(RehearsalPlan& plan) {
  if (!plan.cut) throw UsageError("--flap closed: there is no planned cut in this patient, leave it out");
  plan.flap_closed = true;
  for (const haptics::HandInstrument kind : {haptics::HandInstrument::scalpel_15, haptics::HandInstrument::periosteal})
    if (std::ranges::find(plan.other_tools, kind, &haptics::Tool::hand_instrument) == plan.other_tools.end())
      plan.other_tools.push_back(haptics::handInstrumentTool(kind));
  plan.command.assistant_holds = plan.device.starts_with("scripted:");
}

}  // namespace app
