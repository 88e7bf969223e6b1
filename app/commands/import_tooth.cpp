#include "app/commands/import_tooth.h"

#include <algorithm>

#include "app/case/dentoform_row.h"
#include "app/case/patient_source.h"
#include "app/commands/patient_words.h"
#include "app/text/list.h"
#include "app/text/parse_number.h"
#include "app/text/usage_error.h"
#include "assets/import/tooth_volume.h"
#include "assets/patient/patient_folder.h"
#include "assets/synthetic/front_row.h"
#include "assets/tooth.h"

namespace app {
namespace {

assets::ToothLevels levelsOf(const std::string& text) {
  if (text.empty()) return assets::kToothLevels;
  constexpr int kApart = 20;  // more than what counts as one level
  assets::ToothLevels levels{};
  std::size_t count = 0;
  for (const std::string_view word : split(text)) {
    const auto level = parseNumber<int>(word);
    if (!level || *level < 0 || *level > 255 || count == levels.size()) {
      count = 0;
      break;
    }
    levels[count++] = *level;
  }
  bool rises = count == levels.size();
  for (std::size_t n = 1; rises && n < levels.size(); ++n) rises = levels[n] - levels[n - 1] >= kApart;
  if (!rises)
    throw UsageError("--levels " + text + ": give AIR,PULP,DENTINE,ENAMEL, four values from 0 to 255, each at least " +
                     std::to_string(kApart) + " above the one before, as in 0,100,150,255");
  return levels;
}

}  // namespace

void addToothOptions(CommandLine& command, const Option& tooth, ToothImport& options) {
  command
      .option("--tooth-number", options.fdi,
              "Which tooth a single tooth's volume shows, FDI number: 11 to 18 … 41 to 48")
      .wholeFrom(11, 48)
      .showsDefault()
      .needs(tooth);
  command
      .option("--levels", options.levels,
              "AIR,PULP,DENTINE,ENAMEL: the densities of a single tooth's volume [0,100,150,255]")
      .needs(tooth);
  command.flag("--upright", options.upright, "Turn a single tooth that lies, or stands upside down, else refused")
      .needs(tooth);
}

void refuseUnknownTooth(const ToothImport& options) {
  if (!isInDentoform(options.fdi))
    throw UsageError("--tooth-number " + std::to_string(options.fdi) +
                     ": no tooth of adults, give 11 to 18, 21 to 28, 31 to 38 or 41 to 48");
  levelsOf(options.levels);
}

std::string importTooth(const ToothImport& options, const std::string& folder, bool force, ImportCourse& course) {
  course.begin("files");
  const assets::ToothVolume tooth =
      assets::readToothVolume(options.volume, {options.fdi, levelsOf(options.levels), options.upright});
  course.begin("row of teeth");
  const DentoformTooth made =
      dentoformTooth(tooth, isInFront(options.fdi) ? assets::frontRow() : builtInPatient(dentoformJaw(options.fdi)).ct,
                     options.fdi, options.volume);
  course.end();
  for (const auto* remarks : {&tooth.remarks, &made.remarks})
    for (const std::string& remark : *remarks) course.say("tooth: " + remark);
  course.begin("writing");
  auto whole = course.whole();
  assets::FolderWatch watch;
  watch.begun = [&](const std::string& begun) {
    course.removeIfStopped(begun);
    whole.unlock();
  };
  watch.before_commit = [&course] { course.commit(); };
  assets::savePatient(made.patient, folder, force, nullptr, "", watch);
  course.end();
  return patientWords(made.patient);
}

}  // namespace app
