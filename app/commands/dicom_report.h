// What a DICOM source holds, for programs and for people, without anything of a person. Any thread.
#pragma once

#include <string>

#include "assets/import/dicom/dicom_survey.h"

namespace app {

/// JSON: files and those passed over, series, verdicts.
std::string dicomReportJson(const assets::DicomSurvey& survey);

/// A table of the volumes, then the verdicts, a line each.
std::string dicomReportText(const assets::DicomSurvey& survey);

}  // namespace app
