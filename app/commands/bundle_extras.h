// What a bundle has beside its tables, where it is asked for and the participant allows it: the voice, pictures of the
// moments that were noted; its report as PDF; all of it encrypted for named recipients. Main thread; the time of the
// recorded steps for pictures, some seconds for the rest.
#pragma once

#include <string>
#include <vector>

#include "app/commands/private_folder.h"
#include "app/study/bundle/study_bundle.h"
#include "calibration/output_file.h"

namespace app {

struct BundleExtras {
  bool voice = false, pictures = false;
  std::string pdf;                      ///< file; empty: none
  std::vector<std::string> recipients;  ///< of age: "age1…"; empty: not encrypted
};

/// Voice only with the words yes on audio and reuse, from the first event of the log on; pictures only with picture.
/// What is left out is told in a remark. `owner` null: what is sealed stays closed. Borrows all.
MoreOfSession moreOfSession(const std::string& study, const BundleExtras& wanted, const PrivateStudyKeys* owner,
                            const PrivateFolder& scratch);

/// Its report.html, printed by Chromium. False: that is not installed. Throws UsageError.
bool printReport(const std::string& bundle, calibration::OutputFile& pdf, const PrivateFolder& scratch);

/// Throws UsageError: age is not installed, or knows no such recipient.
void encryptFor(const std::vector<std::string>& recipients, const std::string& bundle, calibration::OutputFile& to);

}  // namespace app
