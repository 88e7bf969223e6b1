// `molar check PATIENT`: what the program found in a scan, looked at, corrected by clicks and confirmed.

#include <memory>
#include <optional>
#include <string>

#include "app/check_page/check_run.h"
#include "app/check_page/show_check_page.h"
#include "app/commands/command.h"
#include "app/station/patient_list.h"
#include "app/text/command_line.h"
#include "app/text/message.h"
#include "assets/patient/statement_file.h"
#include "calibration/output_file.h"
#include "calibration/png_file.h"

namespace app {
namespace {

constexpr glm::ivec2 kSnapshot_px{1280, 800};

struct CheckPageOptions {
  std::string patient, snapshot;
  bool force = false, is_reviewed = false;
};

int checkPage(const CheckPageOptions& options) {
  const std::string folder = patientNamed(options.patient);
  if (options.is_reviewed) {
    assets::reviewStatement(folder);
    printMessage("deidentified.toml says now that a person has looked at the pictures");
    return 0;
  }
  if (options.snapshot.empty()) {
    showCheckPage(folder, printMessage);
    return 0;
  }
  calibration::OutputFile file(options.snapshot, options.force);
  CheckRun run(folder, printMessage);
  run.finish();
  const render::Image picture = run.picture(kSnapshot_px);
  calibration::writePng(file.temporaryPath(), {picture.w, picture.h}, picture.rgba);
  file.commit();
  return 0;
}

}  // namespace

void addCheck(CommandLine& molar) {
  auto options = std::make_shared<CheckPageOptions>();
  CommandLine& command = molar.command("check", "Looks at what was found in a scan, corrects and confirms it");
  command.option("PATIENT", options->patient, kPatientHelp).required();
  command.option("--snapshot", options->snapshot, "The page as a picture, PNG, without a window");
  command.flag("--force", options->force, "Replace the picture if it exists");
  command.flag("--pictures-reviewed", options->is_reviewed,
               "You looked at all pictures of a DICOM scan and they name nobody: said in deidentified.toml");
  command.does([options] { return checkPage(*options); });
}

}  // namespace app
