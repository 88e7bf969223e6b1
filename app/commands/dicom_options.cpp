#include "app/commands/dicom_options.h"

#include "app/imaging_server/server_address.h"
#include "app/text/list.h"
#include "app/text/parse_number.h"
#include "app/text/usage_error.h"
#include "assets/import/scan_import.h"

namespace app {

void addDicomOptions(CommandLine& command, DicomOptions& options) {
  command.optionGroup("DICOM");
  command.option("--series", options.choices.series, "Volume to take, by its number in molar inspect [the best]");
  command.option("--without", options.choices.without, "File to leave out, as a message names it").repeated();
  command.flag("--fill-gaps", options.choices.fill_gaps, "Bridge up to three missing slices by interpolation");
  command.option("--spacing", options.spacing,
                 "Millimetres of a voxel, one or ROW,COLUMN,SLICE, where the files state none");
  command.flag("--assume-order", options.choices.assume_order,
               "Slices without a position lie in the order of their numbers; needs --spacing");
  command.flag("--spacing-from-thickness", options.choices.spacing_from_thickness,
               "Slices without a position touch each other");
  command.flag("--burnt-in-checked", options.choices.burnt_in_checked,
               "The text in the pictures was looked at and names nobody");
  command.optionGroup("Imaging server");
  command.option("--find", options.server.find, "Whose scan, as in \"PatientID=…\"; several joined by &")
      .valueNamed("KEY=VALUE");
  command.option("--study", options.server.study, "Its number in the list of studies").from(1, 200);
}

assets::DicomChoices dicomChoices(const DicomOptions& options) {
  assets::DicomChoices choices = options.choices;
  if (options.spacing.empty()) return choices;
  const std::vector<std::string_view> words = split(options.spacing);
  std::vector<double> numbers;
  for (const std::string_view word : words)
    if (const auto number = parseNumber<double>(word); number && *number >= 0.02 && *number <= 5.0)
      numbers.push_back(*number);
  if (numbers.size() != words.size() || (numbers.size() != 1 && numbers.size() != 3))
    throw UsageError("--spacing " + options.spacing + ": give one number or ROW,COLUMN,SLICE, 0.02 to 5 mm");
  choices.spacing_mm = numbers.size() == 1 ? glm::dvec3(numbers[0]) : glm::dvec3(numbers[0], numbers[1], numbers[2]);
  return choices;
}

SurveyedSource surveySource(const std::string& source, const DicomOptions& options) {
  const assets::DicomChoices choices = dicomChoices(options);
  if (!isServerAddress(source)) return {std::nullopt, assets::surveyDicom(source, choices)};
  SurveyedSource made{receiveScan(source, options.server), {}};
  made.survey = assets::surveyDicom(*made.received, choices);
  return made;
}

bool isDicomOrServer(const std::string& source, const DicomOptions& options) {
  if (isServerAddress(source)) return true;
  if (!options.server.find.empty() || options.server.study)
    throw UsageError("--find and --study ask a server; give its address, as in https://pacs.example/dicom-web");
  return assets::isDicomSource(source);
}

}  // namespace app
