#include "app/review/session_review.h"

#include "app/case/patient_source.h"
#include "app/options/law_text.h"
#include "app/review/site_view.h"
#include "app/session/fragments_event.h"
#include "app/station/session_case.h"
#include "assets/patient/patient_folder.h"

namespace app {
namespace {

/// The whole scan that a treated tooth is of.
std::optional<assets::CtVolume> jawOf(const StoredStart& start, const std::string& folder) {
  if (!folder.empty()) return assets::loadPatient(folder).ct;
  if (start.setup.built_in) return builtInPatient(*start.setup.built_in).ct;
  return {};
}

}  // namespace

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
  const auto& laid = again.left.laid;
  if (const auto treated = treatmentOfSession(session, start, again.left)) {
    const std::optional<assets::CtVolume> jaw = jawOf(start, again.patient_folder);
    const auto metal = fragmentsIn(start.setup, session.events());
    review.treatment.emplace(TreatmentReview{
        *treated, treatmentFilms(start, {again.left.solid, metal, laid ? &*laid : nullptr}, jaw ? &*jaw : nullptr)});
  }

  review.preparation = preparationOfSession(session, start, again.left);
  if (again.patient != nullptr && again.patient->site)
    review.plan = extractionPlan(*again.patient, again.patient->title);
  else
    review.why_no_plan = start.setup.practice.empty() ? "the patient's folder was not named, or is of another version"
                                                      : "a practice block has none";
  review.is_against_plan = static_cast<bool>(about.from_plan_mm);
  const SiteView site = siteViewOf(start, again.patient, again.left.solid);
  review.pictures = bonePictures({start.grid, start.label, start.solid, again.left.solid, laid ? &*laid : nullptr},
                                 site, about.from_plan_mm, {480, 420});
  return review;
}

}  // namespace app
