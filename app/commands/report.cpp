// `molar report SESSION --out FILE.html`: a recorded rehearsal as a page for its surgeon and supervisor.

#include <memory>
#include <optional>

#include "app/commands/command.h"
#include "app/review/review_page.h"
#include "app/session/session_folder.h"
#include "app/station/patient_list.h"
#include "app/text/command_line.h"
#include "app/text/usage_error.h"
#include "calibration/output_file.h"

namespace app {
namespace {

struct ReportOptions {
  std::string session, out, patient, compare;
  bool force = false;
};

int report(const ReportOptions& options) {
  if (!options.out.ends_with(".html")) throw UsageError("--out " + options.out + ": a report is a page, name it .html");
  calibration::OutputFile out(options.out, options.force);
  const std::string patient = options.patient.empty() ? "" : patientNamed(options.patient);
  const SessionReview review = reviewOf(sessionNamed(options.session), patient);
  std::optional<SessionMetrics> other;
  if (!options.compare.empty()) {
    other = metricsOf(sessionNamed(options.compare));
    if (other->patient_title != review.metrics.patient_title)
      throw UsageError("--compare " + options.compare + ": is of another case (" + other->patient_title +
                       "), name a session of " + review.metrics.patient_title);
  }
  out.commit(reviewHtml(review, other ? &*other : nullptr));
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
  command.flag("--force", options->force, "Replace the output if it exists");
  command.does([options] { return report(*options); });
}

}  // namespace app
