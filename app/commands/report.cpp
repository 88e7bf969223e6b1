// `molar report SESSION --out FILE.html`: a recorded rehearsal as a page for its surgeon and supervisor.

#include <memory>
#include <optional>

#include "app/commands/command.h"
#include "app/debrief/moment_pictures.h"
#include "app/review/review_page.h"
#include "app/review/session_trend.h"
#include "app/session/session_folder.h"
#include "app/station/patient_list.h"
#include "app/station/session_case.h"
#include "app/text/command_line.h"
#include "app/text/message.h"
#include "app/text/usage_error.h"
#include "calibration/output_file.h"

namespace app {
namespace {

struct ReportOptions {
  std::string session, out, patient, compare, reference, trend;
  bool force = false;
};

int report(const ReportOptions& options) {
  if (!options.out.ends_with(".html")) throw UsageError("--out " + options.out + ": a report is a page, name it .html");
  calibration::OutputFile out(options.out, options.force);
  const std::string patient = options.patient.empty() ? "" : patientNamed(options.patient);
  std::optional<ReferenceSet> set;
  if (!options.reference.empty()) set = loadReference(options.reference);
  const std::string session = sessionNamed(options.session);
  SessionReview review = reviewOf(session, patient, [&](const std::vector<ToldMoment>& moments) {
    return momentPictures(session, patient, moments);
  });
  if (set) tellAgainst(review.metrics, *set);
  std::optional<SessionMetrics> other;
  if (!options.compare.empty()) {
    other = metricsOf(sessionNamed(options.compare), caseOfSession);
    if (other->patient_title != review.metrics.patient_title)
      throw UsageError("--compare " + options.compare + ": is of another case (" + other->patient_title +
                       "), name a session of " + review.metrics.patient_title);
  }
  std::vector<CaseTrend> trend;
  if (!options.trend.empty()) trend = trendOf(options.trend, printMessage, review.metrics.patient_title);
  out.commit(
      reviewHtml(review, {other ? &*other : nullptr, set ? &*set : nullptr, trend.empty() ? nullptr : &trend.front()}));
  return 0;
}

}  // namespace

void addReport(CommandLine& molar) {
  auto options = std::make_shared<ReportOptions>();
  CommandLine& command =
      molar.command("report", "A recorded rehearsal as one page: errors, measures, pictures, course");
  command.option("SESSION", options->session, kSessionHelp).required();
  command.option("--out", options->out, "The page, .html; it needs no other file").required();
  command.option("--patient", options->patient, "Of an imported patient: its folder, for plan and pictures");
  command.option("--compare", options->compare, "A session of the same case, its measures beside");
  command.option("--reference", options->reference, kReferenceHelp).valueNamed("SET");
  command.option("--trend", options->trend, "Measures of all sessions of the case in this folder over time")
      .valueNamed("FOLDER");
  command.flag("--force", options->force, "Replace the output if it exists");
  command.does([options] { return report(*options); });
}

}  // namespace app
