#include "app/review/session_review.h"

#include "app/options/law_text.h"
#include "app/review/site_view.h"
#include "app/station/session_case.h"

namespace app {

SessionReview reviewOf(const std::string& path, const RunAgain& again) {
  const StoredStart& start = again.start;
  const SessionCase about = caseOfSessionWith(start, again.risks);
  SessionReview review;
  review.metrics = metricsOf(
      path, [&about](const StoredStart&) { return about; }, &again.left);
  SessionReader session(path);
  review.course = courseOf(session);
  review.started_utc = start.started_utc;
  const std::vector<SessionCommand> commands = session.commands();
  review.law = lawName((commands.empty() ? haptics::Command() : commands.back().command).law.kind);
  review.has_canal = !about.risks.of(assets::RiskStructure::canal).isEmpty();
  review.moments = again.draw(toldMoments(review.metrics, review.course));
  review.remarks = again.remarks;

  if (again.patient != nullptr && again.patient->site)
    review.plan = extractionPlan(*again.patient, again.patient->title);
  else
    review.why_no_plan = start.setup.practice.empty() ? "the patient's folder was not named, or is of another version"
                                                      : "a practice block has none";
  review.is_against_plan = static_cast<bool>(about.from_plan_mm);
  const SiteView site = siteViewOf(start, again.patient, again.left.solid);
  review.pictures =
      bonePictures({start.grid, start.label, start.solid, again.left.solid}, site, about.from_plan_mm, {480, 420});
  return review;
}

}  // namespace app
