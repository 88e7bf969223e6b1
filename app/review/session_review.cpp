#include "app/review/session_review.h"

#include <limits>

#include "app/case/gutter_plan.h"
#include "app/case/operated_crown.h"
#include "app/case/trough_plan.h"
#include "app/options/law_text.h"
#include "app/session/replay.h"
#include "app/station/session_patient.h"
#include "app/station/session_risks.h"
#include "assets/cut_field.h"

namespace app {
namespace {

/// Where no patient tells: the middle of the tooth, or of what was removed.
SiteView siteFromBone(const StoredStart& start, std::span<const std::uint8_t> after) {
  SiteView site;
  glm::dvec3 sum(0.0);
  double weight = 0.0;
  const bool by_tooth = !start.is_tooth.empty();
  assets::forVoxels(start.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const double w = by_tooth ? (start.is_tooth[v] != 0 ? 1.0 : 0.0) : std::max(0, start.solid[v] - after[v]) / 255.0;
    sum += w * start.grid.centre_P_mm(ijk);
    weight += w;
  });
  const glm::dvec3 middle = start.grid.centre_P_mm(start.grid.size / 2);
  site.middle_P_mm = weight > 0.0 ? sum / weight : middle;
  if (site.middle_P_mm.x < middle.x) site.buccal_P.x = -1.0;
  return site;
}

SiteView siteOf(const assets::Patient& patient) {
  const SiteAxes axes = siteAxes(patient.ct, *patient.site);
  return {patient.site->centre_P_mm + 3.0 * axes.up_P, axes.distal_P, axes.buccal_P, axes.up_P};
}

PlanComparison comparisonOf(const StoredStart& start, std::span<const std::uint8_t> after,
                            const assets::PlannedCut& cut) {
  constexpr double kFarthest_mm = 12.0;
  const assets::CutField field(cut, kFarthest_mm);
  const auto is_bone = [&](std::size_t v) {
    const auto tissue = static_cast<assets::Tissue>(start.label[v]);
    return tissue == assets::Tissue::cortical || tissue == assets::Tissue::trabecular;
  };
  return compareWithPlan(start.grid, start.solid, after, is_bone,
                         [&](const glm::dvec3& p) { return field.distance_mm(p); });
}

}  // namespace

SessionReview reviewOf(const std::string& path, const std::string& patient_folder) {
  SessionReview review;
  review.metrics = metricsOf(path, risksOfSession);
  SessionReader session(path);
  review.course = courseOf(session);
  const ReplayedState end = replayTo(session, std::numeric_limits<double>::infinity());
  const StoredStart& start = end.start;
  review.started_utc = start.started_utc;
  review.law = lawName(end.command.law.kind);
  // As recorded; which pieces are out is the replay's.
  const std::vector<std::uint8_t> in_mouth = end.bodies.solidInMouth(), whole = boneAtTime(path, {}).solid;

  const std::optional<assets::Patient> patient = patientOfSession(start, patient_folder);
  std::optional<assets::PlannedCut> cut;
  if (patient && patient->site) {
    review.plan = extractionPlan(*patient, patient->title);
    if (const auto planned = plannedCut(*patient, kUsualBurRadius_mm); planned && planned->kind == CutKind::gutter) {
      cut = planned->cut;
      review.against_plan = comparisonOf(start, whole, *cut);
    } else {
      review.why_no_plan = "no gutter could be planned for this tooth";
    }
  } else {
    review.why_no_plan = "the patient's folder was not named, or is of another version";
  }
  const SiteView site = patient && patient->site ? siteOf(*patient) : siteFromBone(start, whole);
  review.pictures = bonePictures({start.grid, start.label, start.solid, in_mouth}, site, cut, {480, 420});
  return review;
}

}  // namespace app
