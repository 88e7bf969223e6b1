#include "app/review/session_review.h"

#include <utility>

#include "app/case/operated_crown.h"
#include "app/options/law_text.h"
#include "app/station/session_case.h"
#include "app/station/session_patient.h"
#include "assets/synthetic/practice_block.h"

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

}  // namespace

SessionReview reviewOf(const std::string& path, const std::string& patient_folder, const RunsAgain& runs_again) {
  SessionReview review;
  SessionCase about;
  review.metrics = metricsOf(path, [&about](const StoredStart& start) { return about = caseOfSession(start); });
  SessionReader session(path);
  review.course = courseOf(session);
  const StoredStart start = session.start();
  review.started_utc = start.started_utc;
  const std::vector<SessionCommand> commands = session.commands();
  review.law = lawName((commands.empty() ? haptics::Command() : commands.back().command).law.kind);
  RunAgain again = runs_again(toldMoments(review.metrics, review.course));
  review.moments = std::move(again.moments);
  review.remarks = std::move(again.remarks);

  const std::optional<assets::Patient> patient = patientOfSession(start, patient_folder);
  if (patient && patient->site)
    review.plan = extractionPlan(*patient, patient->title);
  else
    review.why_no_plan = start.setup.practice.empty() ? "the patient's folder was not named, or is of another version"
                                                      : "a practice block has none";
  review.is_against_plan = static_cast<bool>(about.from_plan_mm);
  const SiteView site = !start.setup.practice.empty() ? siteOfBlock()
                        : patient && patient->site    ? siteOf(*patient)
                                                      : siteFromBone(start, again.in_mouth);
  review.pictures =
      bonePictures({start.grid, start.label, start.solid, again.in_mouth}, site, about.from_plan_mm, {480, 420});
  return review;
}

}  // namespace app
