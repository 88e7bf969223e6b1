// `molar calibrate report`: one page that stands alone, for whoever signs.

#include <memory>

#include "app/calibrate/report/calibration_report.h"
#include "app/commands/calibrate/calibrate.h"
#include "app/text/command_line.h"
#include "calibration/output_file.h"
#include "calibration/record/drift_review.h"
#include "calibration/record/utc.h"

namespace app {
namespace {

struct ReportOptions {
  std::string rig;
  KeepOption keep;
};

int report(const ReportOptions& options) {
  calibration::OutputFile file(options.keep.out, options.keep.force);
  const calibration::RigRecord record = baseRig(options.rig);
  const auto history = calibration::readHistory(options.keep.rigs().historyPath(options.keep.placeOf(record)));
  file.commit(reportHtml(calibration::withLaterCheck(record, history), history, calibration::nowUtc()));
  return 0;
}

}  // namespace

void addCalibrateReport(CommandLine& calibrate) {
  auto o = std::make_shared<ReportOptions>();
  CommandLine& command = calibrate.command("report", "A calibration as one HTML page: how good, where, since when");
  command.option("RIG", o->rig, kBaseRigHelp).required();
  command.option("--out,--html", o->keep.out, "Page to write, .html").valueNamed("FILE").required();
  addStore(command, o->keep.store);
  command.flag("--force", o->keep.force, "Replace a file that exists");
  command.does([o] { return report(*o); });
}

}  // namespace app
