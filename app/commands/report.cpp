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

/// Of the same case, measured.
SessionMetrics otherOf(const std::string& name, const std::string& case_title) {
  const std::string path = sessionNamed(name);
  const std::string title = SessionReader(path).about().patient_title;
  if (title != case_title)
    throw UsageError("--compare " + name + ": is of another case (" + title + "), name a session of " + case_title);
  return metricsOf(path, caseOfSession);
}

int report(const ReportOptions& options) {
  if (!options.out.ends_with(".html")) throw UsageError("--out " + options.out + ": a report is a page, name it .html");
  calibration::OutputFile out(options.out, options.force);
  // All that is named is looked at before the session is run again.
  const std::string patient = options.patient.empty() ? "" : patientNamed(options.patient);
  const std::string session = sessionNamed(options.session);
  const std::string case_title = SessionReader(session).about().patient_title;
  std::optional<ReferenceSet> set;
  if (!options.reference.empty()) refuseOtherCase(case_title, set.emplace(loadReference(options.reference)));
  if (!options.trend.empty()) refuseMissingFolder(options.trend);
  std::optional<SessionMetrics> other;
  if (!options.compare.empty()) other = otherOf(options.compare, case_title);

  SessionReview review = reviewWithPictures(session, patient);
  if (set) tellAgainst(review.metrics, *set);
  std::optional<CaseTrend> trend;
  if (!options.trend.empty()) {
    trend = trendOf(options.trend, printMessage, session, review.metrics);
    if (!trend) printMessage("--trend " + options.trend + ": holds no session of " + case_title);
  }
  out.commit(reviewHtml(review, {other ? &*other : nullptr, set ? &*set : nullptr, trend ? &*trend : nullptr}));
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
