#include "app/station/session_case.h"

#include <memory>
#include <utility>

#include "app/case/gutter_plan.h"
#include "app/case/impaction_measures.h"
#include "app/case/trough_plan.h"
#include "app/station/session_patient.h"
#include "app/station/session_risks.h"
#include "assets/cut_field.h"
#include "assets/synthetic/face.h"
#include "assets/synthetic/practice_block.h"

namespace app {
namespace {

constexpr double kFarthest_mm = 12.0;  ///< off the plan that is told

constexpr std::string_view kGoesOn = "the rehearsal goes on from another, whose plan is not told again";

void plan(SessionCase& known, const StoredStart& start, const assets::Patient& patient) {
  if (start.setup.former) {
    known.why_no_plan = kGoesOn;
    return;
  }
  const auto planned = plannedCut(patient, kUsualBurRadius_mm);
  if (!planned || planned->kind != CutKind::gutter) {
    known.why_no_plan = "no gutter could be planned for this tooth";
    return;
  }
  known.plan = planned->cut;
  const auto field = std::make_shared<assets::CutField>(*known.plan, kFarthest_mm);
  known.from_plan_mm = [field](const glm::dvec3& p) { return field->distance_mm(p); };
}

SessionCase practiceCase(assets::PracticeTask task, const StoredStart& start) {
  SessionCase known;
  if (start.setup.former) {
    known.why_no_plan = kGoesOn;
    return known;
  }
  known.plan = assets::practiceCut(task, assets::textOf(task).bur_radius_mm);
  known.from_plan_mm = [task](const glm::dvec3& p) { return assets::fromTarget_mm(task, p); };
  return known;
}

/// `patient`: within the session.
SessionCase operationCase(const StoredStart& start, const assets::Patient& patient, assets::RiskStructures risks) {
  SessionCase known;
  known.risks = std::move(risks);
  if (!patient.site) {
    known.why_no_plan = "no operated tooth is known";
    return known;
  }
  const ArchFrame frame = archFrame(patient);
  known.directions = CaseDirections{frame.distal_P, frame.buccal_P, frame.up_P};
  known.sight_P = assets::surgeonEyeDirection(patient.site->fdi);
  plan(known, start, patient);
  return known;
}

}  // namespace

SessionCase caseOfSession(const StoredStart& start) {
  if (const auto task = assets::practiceTaskOf(start.setup.practice)) return practiceCase(*task, start);
  const assets::Patient patient = patientWithinSession(start);
  return operationCase(start, patient, risksOfSession(start, patient));
}

SessionCase caseOfSessionWith(const StoredStart& start, const assets::RiskStructures& risks) {
  if (const auto task = assets::practiceTaskOf(start.setup.practice)) return practiceCase(*task, start);
  return operationCase(start, patientWithinSession(start), risks);
}

}  // namespace app
