// `molar inspect SOURCE`: what a patient folder, a DICOM folder or a server's study holds.

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "app/commands/command.h"
#include "app/commands/dicom_options.h"
#include "app/commands/dicom_report.h"
#include "app/commands/patient_words.h"
#include "app/station/patient_list.h"
#include "app/text/command_line.h"
#include "assets/patient/patient_folder.h"

namespace app {
namespace {

struct InspectOptions {
  std::string patient;
  DicomOptions dicom;
  bool json = false;
};

bool isPatientFolder(const std::string& path) {
  std::error_code error;
  return std::filesystem::exists(std::filesystem::path(path) / "patient.toml", error);
}

int inspect(const InspectOptions& options) {
  if (!isPatientFolder(options.patient) && isDicomOrServer(options.patient, options.dicom)) {
    const SurveyedSource source = surveySource(options.patient, options.dicom);
    const assets::DicomSurvey& survey = source.survey;
    std::fputs((options.json ? dicomReportJson(survey) : dicomReportText(survey)).c_str(), stdout);
    return 0;
  }
  const std::string folder = patientNamed(options.patient);
  const assets::Patient patient = assets::loadPatient(folder);
  const auto statement = assets::statementIn(folder);
  std::fputs((options.json ? patientJson(patient, statement) : patientWords(patient, statement)).c_str(), stdout);
  return 0;
}

}  // namespace

void addInspect(CommandLine& molar) {
  auto options = std::make_shared<InspectOptions>();
  CommandLine& command = molar.command("inspect", "What a patient folder, a DICOM folder or a server's study holds");
  command.option("PATIENT", options->patient, kPatientHelp).required();
  command.flag("--json", options->json, "For programs");
  addDicomOptions(command, options->dicom);
  command.does([options] { return inspect(*options); });
}

}  // namespace app
