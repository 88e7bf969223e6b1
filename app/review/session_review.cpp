#include "app/review/session_review.h"

#include <limits>

#include "app/case/operated_crown.h"
#include "app/options/law_text.h"
#include "app/session/replay.h"
#include "app/station/session_case.h"
#include "app/station/session_patient.h"
#include "assets/synthetic/practice_block.h"
#include "assets/tissue.h"

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

/// Of a practice block: over its face.
SiteView siteOfBlock() {
  return {glm::dvec3(0.0), assets::fromBlock({1.0, 0.0, 0.0}), -assets::fromBlock({0.0, 1.0, 0.0}),
          assets::fromBlock({0.0, 0.0, 1.0})};
}

PlanComparison comparisonOf(const StoredStart& start, std::span<const std::uint8_t> after,
                            const std::function<double(const glm::dvec3&)>& from_plan_mm) {
  const auto is_bone = [&](std::size_t v) {
    const auto tissue = static_cast<assets::Tissue>(start.label[v]);
    return tissue == assets::Tissue::cortical || tissue == assets::Tissue::trabecular;
  };
  return compareWithPlan(start.grid, start.solid, after, is_bone, from_plan_mm);
}

}  // namespace

SessionReview reviewOf(const std::string& path, const std::string& patient_folder) {
  SessionReview review;
  review.metrics = metricsOf(path, caseOfSession);
  SessionReader session(path);
  review.course = courseOf(session);
  const ReplayedState end = replayTo(session, std::numeric_limits<double>::infinity());
  const StoredStart& start = end.start;
  review.started_utc = start.started_utc;
  review.law = lawName(end.command.law.kind);
  // As recorded; which pieces are out is the replay's.
  const std::vector<std::uint8_t> in_mouth = end.bodies.solidInMouth(), whole = boneAtTime(path, {}).solid;

  const std::optional<assets::Patient> patient = patientOfSession(start, patient_folder);
  const SessionCase about = caseOfSession(start);
  if (patient && patient->site)
    review.plan = extractionPlan(*patient, patient->title);
  else
    review.why_no_plan = start.setup.practice.empty() ? "the patient's folder was not named, or is of another version"
                                                      : "a practice block has none";
  if (about.from_plan_mm) review.against_plan = comparisonOf(start, whole, about.from_plan_mm);
  const SiteView site = !start.setup.practice.empty() ? siteOfBlock()
                        : patient && patient->site    ? siteOf(*patient)
                                                      : siteFromBone(start, whole);
  review.pictures =
      bonePictures({start.grid, start.label, start.solid, in_mouth}, site, about.from_plan_mm, {480, 420});
  return review;
}

}  // namespace app
