// What the owner of a DICOM scan may say about it on the command line, for import and inspect. Main thread, start-up.
#pragma once

#include <string>
#include <vector>

#include "app/text/command_line.h"
#include "assets/import/dicom/dicom_survey.h"

namespace app {

struct DicomOptions {
  assets::DicomChoices choices;
  std::string spacing;
};

void addDicomOptions(CommandLine& command, DicomOptions& options);

/// With the spacing read. Throws UsageError.
assets::DicomChoices dicomChoices(const DicomOptions& options);

}  // namespace app
