// What the owner of a DICOM scan may say about it on the command line, for import and inspect, and the survey of such a
// source, in a folder or on a server. Main thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/imaging_server/received_scan.h"
#include "app/text/command_line.h"
#include "assets/import/dicom/dicom_survey.h"

namespace app {

struct DicomOptions {
  assets::DicomChoices choices;
  std::string spacing;
  ServerQuestion server;
};

void addDicomOptions(CommandLine& command, DicomOptions& options);

/// With the spacing read. Throws UsageError.
assets::DicomChoices dicomChoices(const DicomOptions& options);

/// A survey, and what a server sent for it.
struct SurveyedSource {
  std::optional<assets::ReceivedFiles> received;
  assets::DicomSurvey survey;
};
/// Of DICOM files or of a server. Throws UsageError or LoadError.
SurveyedSource surveySource(const std::string& source, const DicomOptions& options);

/// A server, or DICOM files. Throws UsageError: a server's options for files.
bool isDicomOrServer(const std::string& source, const DicomOptions& options);

}  // namespace app
