#include "app/review/session_review.h"

#include <utility>

#include "app/options/law_text.h"
#include "app/review/site_view.h"
#include "app/station/session_case.h"
#include "app/station/session_patient.h"

namespace app {
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
  const SiteView site = siteViewOf(start, patient, again.in_mouth);
  review.pictures =
      bonePictures({start.grid, start.label, start.solid, again.in_mouth}, site, about.from_plan_mm, {480, 420});
  return review;
}

}  // namespace app
