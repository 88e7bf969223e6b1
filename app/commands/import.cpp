// `molar import SOURCE --out PATIENT`: a scan becomes a patient folder, de-identified, and is checked. A single tooth:
// import_tooth.h.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include <unistd.h>

#include <nlohmann/json.hpp>

#include "app/case/built_in_face.h"
#include "app/case/gutter_plan.h"
#include "app/check_page/check_picture.h"
#include "app/check_page/check_run.h"
#include "app/check_page/show_check_page.h"
#include "app/commands/command.h"
#include "app/commands/dicom_options.h"
#include "app/commands/dicom_report.h"
#include "app/commands/import_course.h"
#include "app/commands/import_tooth.h"
#include "app/commands/patient_words.h"
#include "app/commands/segmenter.h"
#include "app/commands/shown_import.h"
#include "app/imaging_server/server_address.h"
#include "app/options/jaw_clicks_file.h"
#include "app/session/data_folder.h"
#include "app/session/session_error.h"
#include "app/station/patient_list.h"
#include "app/text/command_line.h"
#include "app/text/list.h"
#include "app/text/message.h"
#include "app/text/parse_number.h"
#include "app/text/usage_error.h"
#include "assets/import/scan_import.h"
#include "assets/load_error.h"
#include "assets/patient/patient_folder.h"
#include "assets/scenery/gingiva_surface.h"
#include "assets/tooth.h"
#include "calibration/output_file.h"

namespace app {
namespace {

struct ImportOptions {
  std::string source, out, tooth, window, scale, report, label_set, segment_with, clicks;
  ToothImport single;  ///< its volume is `tooth` where that is no number
  DicomOptions dicom;
  assets::ScanImportOptions choices;
  bool no_face = false, no_check = false, force = false;
  bool is_shown = false;  ///< in a window while it works
};

/// "hu", "hu+1024", or the grey values of air, muscle and dentine.
assets::GreyMap scaleOf(const std::string& text) {
  if (text == "hu") return {};
  if (text == "hu+1000") return {assets::GreyScale::shifted, 1.0, -1000.0};
  if (text == "hu+1024") return {assets::GreyScale::shifted, 1.0, -1024.0};
  std::vector<double> greys;
  for (const std::string_view word : split(text))
    if (const auto grey = parseNumber<double>(word)) greys.push_back(*grey);
  const auto map = greys.size() == 3 ? assets::greyMapFromTissues({greys[0], greys[1], greys[2]}) : std::nullopt;
  if (!map)
    throw UsageError("--scale " + text +
                     ": give hu, hu+1000, hu+1024, or AIR,MUSCLE,DENTINE: three grey values, rising, as in 0,610,1560");
  return *map;
}

/// LOW:HIGH in HU.
assets::GreyWindow windowOf(const std::string& text) {
  const std::vector<std::string_view> ends = split(text, ':');
  const auto low_hu = parseNumber<double>(ends.front()), high_hu = parseNumber<double>(ends.back());
  if (ends.size() != 2 || !low_hu || !high_hu || *low_hu < -2000.0 || *high_hu > 32000.0 || *low_hu >= *high_hu)
    throw UsageError("--window " + text + ": give LOW:HIGH in HU, from -2000 to 32000, LOW below HIGH");
  return {*low_hu, *high_hu};
}

/// What was found in a scan without labels.
nlohmann::json jsonOf(const assets::FoundJaw& jaw) {
  nlohmann::json teeth = nlohmann::json::array();
  for (const assets::FoundTooth& tooth : jaw.teeth)
    teeth.push_back({{"fdi", tooth.fdi == 0 ? nlohmann::json(nullptr) : nlohmann::json(tooth.fdi)},
                     {"confirmed", tooth.told_fdi != 0},
                     {"volume_mm3", tooth.volume_mm3},
                     {"centre_P_mm", {tooth.centre_P_mm.x, tooth.centre_P_mm.y, tooth.centre_P_mm.z}}});
  nlohmann::json canals = nlohmann::json::array();
  for (const assets::CanalProposal& canal : jaw.canals) {
    nlohmann::json line = nlohmann::json::array();
    for (const glm::dvec3& p : canal.line_P_mm) line.push_back({p.x, p.y, p.z});
    canals.push_back(
        {{"side", canal.is_right ? "right" : "left"}, {"confirmed", canal.is_confirmed}, {"line_P_mm", line}});
  }
  return {{"cortical_hu", jaw.levels.cortical_hu},
          {"dentine_hu", jaw.levels.dentine_hu},
          {"teeth", teeth},
          {"canals", canals}};
}

/// What an import leaves behind.
struct Imported {
  std::string words;         ///< on the patient
  bool is_to_check = false;  ///< something was found by the program, or pictures are to be reviewed
};

/// A DICOM source is surveyed before; its path may name a person and is said nowhere. The report is written whether it
/// is refused or not.
assets::ImportedScan importDicom(const ImportOptions& options, ImportCourse& course, nlohmann::json& report) {
  course.begin(isServerAddress(options.source) ? "receiving" : "files");
  SurveyedSource source = surveySource(options.source, options.dicom);
  assets::DicomSurvey& survey = source.survey;
  try {
    assets::ImportedScan imported = assets::importScan(survey, options.choices);
    report = nlohmann::json::parse(dicomReportJson(survey));
    for (const assets::DicomVerdict& verdict : survey.verdicts) course.say(assets::lineOf(verdict));
    return imported;
  } catch (const assets::LoadError&) {
    report = nlohmann::json::parse(dicomReportJson(survey));
    throw;
  }
}

assets::ImportedScan importFile(const ImportOptions& options, ImportCourse& course, nlohmann::json& report) {
  course.begin("files");
  report = {{"kind", "volume"}, {"verdicts", nlohmann::json::array()}};
  try {
    return assets::importScan(options.source, options.choices);
  } catch (const assets::JawRefused& refused) {
    report["verdicts"].push_back(
        {{"code", refused.refusal.code}, {"sentence", refused.refusal.sentence}, {"stops", true}});
    throw;
  }
}

/// The names and seconds of those that have ended.
nlohmann::json jsonOf(const ImportStages& stages) {
  nlohmann::json list = nlohmann::json::array();
  for (const ImportStage& stage : stages.all())
    if (stage.state == ImportStage::State::done) list.push_back({{"stage", stage.name}, {"seconds", stage.took_s}});
  return list;
}

assets::ImportedScan importAny(ImportOptions& options, ImportCourse& course) {
  // Whether it can be written, before the work.
  if (!options.report.empty()) {
    const auto whole = course.whole();
    calibration::OutputFile(options.report, options.force);
  }
  nlohmann::json report;
  options.choices.stage = [&course](std::string_view stage) { course.begin(stage); };
  if (options.is_shown) {
    options.choices.grey = [&course](const assets::VolumeGrid& grid, const std::vector<std::int16_t>& hounsfield) {
      course.view().takeGrey(grid, hounsfield);
    };
    options.choices.so_far = [&course](const assets::JawSoFar& jaw) { course.view().takeJaw(jaw); };
  }
  const auto write = [&] {
    if (report.is_null()) return;
    report["stages"] = jsonOf(course.stages());
    const auto whole = course.whole();
    if (!options.report.empty()) calibration::OutputFile(options.report, options.force).commit(report.dump(2) + "\n");
  };
  const bool is_dicom = isDicomOrServer(options.source, options.dicom);
  try {
    assets::ImportedScan imported =
        is_dicom ? importDicom(options, course, report) : importFile(options, course, report);
    course.end();
    report["jaw"] = imported.jaw ? jsonOf(*imported.jaw) : nlohmann::json(nullptr);
    write();
    for (const std::string& remark : imported.remarks) course.say((is_dicom ? "scan" : options.source) + ": " + remark);
    return imported;
  } catch (const assets::LoadError&) {
    course.abandon();
    write();
    throw;
  }
}

/// As `molar check` finds it, without the folders above: they can be named after a person.
std::string nameOf(const std::string& folder) {
  const std::filesystem::path path = std::filesystem::path(folder).lexically_normal();
  return (path.has_filename() ? path : path.parent_path()).filename().string();
}

/// From the source to the patient folder.
Imported importWhole(ImportOptions& options, ImportCourse& course) {
  std::optional<Segmenter> segmenter;
  if (!options.segment_with.empty()) {
    segmenter.emplace(options.segment_with);
    options.choices.segment = [&](const assets::VolumeGrid& grid, const std::vector<std::int16_t>& grey) {
      course.begin("outside program");
      course.leaveStopsToCaller(true);
      std::string labels = segmenter->labels(grid, grey);
      course.removeIfStopped(segmenter->folder());
      course.leaveStopsToCaller(false);
      course.begin("label map");
      return labels;
    };
  }
  assets::ImportedScan imported = importAny(options, course);
  assets::Patient& patient = imported.patient;
  course.begin("gum");
  patient.gingiva = assets::gingivaSurface(patient.ct, planGutter(patient, kUsualBurRadius_mm));
  course.begin("face");
  if (options.choices.keep_face && !options.no_face && !placeOwnFace(patient))
    course.say("the scan shows too little skin for a face");
  if (!options.no_face && patient.site && patient.face.parts.empty())
    if (const std::string why_not = placeBuiltInFace(patient); !why_not.empty())
      course.say("without a face: " + why_not);
  course.begin("writing");
  // Nothing of the folder is there that a stop does not know of.
  auto whole = course.whole();
  assets::FolderWatch watch;
  watch.begun = [&](const std::string& folder) {
    course.removeIfStopped(folder);
    whole.unlock();
    if (imported.jaw) keepCheckPicture(patient, folder);
  };
  watch.before_commit = [&course] { course.commit(); };
  assets::savePatient(patient, options.out, options.force, imported.origin ? &*imported.origin : nullptr,
                      options.choices.clicks.isEmpty() ? "" : jawClicksText(options.choices.clicks), watch);
  // Edits of another import of this folder.
  std::error_code ignored;
  std::filesystem::remove(checkLogPath(options.out), ignored);
  course.end();
  return {patientWords(patient), patient.isProposed() || imported.origin.has_value()};
}

/// On the start screen.
bool isOffered(const std::string& patient_folder) {
  std::error_code error;
  const std::filesystem::path path = std::filesystem::absolute(patient_folder, error).lexically_normal();
  const std::filesystem::path parent = (path.has_filename() ? path : path.parent_path()).parent_path();
  try {
    return std::filesystem::equivalent(parent, usualPatientFolder(), error);
  } catch (const SessionError&) {  // no data folder: there is nothing to say
    return true;
  }
}

/// Somebody who may look at it, and stop it.
bool isWatched(const ImportOptions& options) {
  const auto is_set = [](const char* name) {
    const char* const value = std::getenv(name);
    return value != nullptr && *value != '\0';
  };
  return !options.no_check && options.report.empty() && isatty(STDIN_FILENO) == 1 && isatty(STDERR_FILENO) == 1 &&
         (is_set("DISPLAY") || is_set("WAYLAND_DISPLAY"));
}

/// `--tooth`: a number of the scan's, or the file of a single tooth.
void readTooth(ImportOptions& options) {
  if (const auto fdi = parseNumber<int>(options.tooth))
    options.choices.tooth_fdi = *fdi;
  else
    options.single.volume = options.tooth;
  if (options.single.volume.empty()) {
    if (options.source.empty())
      throw UsageError("SOURCE: name a folder of DICOM files or a volume file, or a single tooth's with --tooth FILE");
    if (options.single.upright || !options.single.levels.empty() || options.single.fdi != ToothImport{}.fdi)
      throw UsageError("--tooth " + options.tooth +
                       ": --tooth-number, --levels and --upright are for a single tooth, whose FILE --tooth names");
    return;
  }
  if (!options.source.empty())
    throw UsageError("--tooth " + options.tooth + ": is no FDI number; a single tooth's file is given without SOURCE");
  refuseUnknownTooth(options.single);
}

int import(ImportOptions options) {
  readTooth(options);
  if (const auto fdi = options.choices.tooth_fdi; fdi && !assets::isToothNumber(*fdi))
    throw UsageError("--tooth " + std::to_string(*fdi) + ": not an FDI number, give 11 to 48 or 51 to 85");
  if (const auto named = std::ranges::find(assets::kLabelSets, options.label_set); named != assets::kLabelSets.end())
    options.choices.label_set = static_cast<assets::LabelSet>(named - assets::kLabelSets.begin());
  if (!options.segment_with.empty() && options.choices.labels)
    throw UsageError("--labels " + *options.choices.labels + ": the map is made by --segment-with, give one of them");
  // Whether it is a command, before the work.
  if (!options.segment_with.empty()) Segmenter(options.segment_with);
  if (!options.clicks.empty()) options.choices.clicks = readJawClicks(options.clicks);
  if (!options.scale.empty()) options.choices.scale = scaleOf(options.scale);
  if (!options.window.empty()) options.choices.window = windowOf(options.window);
  const bool has_no_place = options.out.empty();
  if (has_no_place) {
    makeDataFolder(usualPatientFolder());
    const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
    options.out = newPatientPath(usualPatientFolder(), now.time_since_epoch().count());
  }
  Imported imported;
  options.is_shown = isWatched(options);
  const auto work = [&](ImportCourse& course) {
    imported = options.single.volume.empty()
                   ? importWhole(options, course)
                   : Imported{importTooth(options.single, options.out, options.force, course), false};
  };
  if (!options.single.volume.empty()) options.is_shown = false;
  const std::unique_ptr<CheckWindow> window = runShown(work, options.is_shown);
  std::fputs(imported.words.c_str(), stderr);
  if (has_no_place)
    printMessage("imported as " + std::filesystem::path(options.out).filename().string() + ", in " +
                 usualPatientFolder().string() + ": rename the folder as you like; molar start offers it");
  else if (!isOffered(options.out))
    printMessage("molar start offers the patients in " + usualPatientFolder().string() +
                 ": move the folder there to have it offered");
  if (!imported.is_to_check) return 0;
  if (window) {
    window->setTitle("Molar: check");
    showCheckPage(*window, options.out, printMessage);
  } else {
    printMessage("look at what was found: molar check " + nameOf(options.out));
  }
  return 0;
}

}  // namespace

void addImport(CommandLine& molar) {
  auto options = std::make_shared<ImportOptions>();
  CommandLine& command = molar.command("import", "A scan becomes a patient folder, de-identified");
  command.example("molar import --tooth TOOTH.nrrd --tooth-number 46 --out PATIENT",
                  "one tooth's densities, set into a row of teeth to be prepared");
  command.option(
      "SOURCE", options->source,
      "Folder of DICOM files; https://HOST/PATH of DICOMweb or dicom://HOST:PORT/AETITLE, with --find; folder with "
      "ct.nrrd, labels.nrrd and teeth.nrrd; or one volume file");
  command.option("--out", options->out,
                 "Patient folder to write [a new one in the data folder, which molar start offers]");
  command.option("--iso", options->choices.classification.iso_hu, "Grey value of the bone's surface, HU")
      .from(-1000.0, 4000.0)
      .showsDefault();
  command.option("--sigma", options->choices.classification.sigma_hu, "Width of the soft transition, HU")
      .from(1.0, 2000.0)
      .showsDefault();
  const Option tooth =
      command
          .option(
              "--tooth", options->tooth,
              "FDI number of the operated tooth [the third molar]; or, without SOURCE, the volume of a single tooth: "
              "uint8 densities air 0, pulp 100, dentine 150, enamel 255 and values between")
          .valueNamed("NUMBER|FILE");
  addToothOptions(command, tooth, options->single);
  const Option window =
      command.option("--window", options->window, "LOW:HIGH, the HU that 0 and 255 of an 8-bit volume mean");
  command.option("--labels", options->choices.labels,
                 "Label map of DentalSegmentator, ToothFairy, TotalSegmentator, AMASSS or Molar");
  command.option("--label-set", options->label_set, "Whose values it has, where the file does not name them")
      .oneOf({assets::kLabelSets.begin(), assets::kLabelSets.end()});
  command.option("--segment-with", options->segment_with,
                 "Command that makes the label map: 'PROGRAM … {ct} … {labels} …', run without a shell");
  command.flag("--force", options->force, "Replace the patient folder if it exists");
  command.flag("--grey-only", options->choices.grey_only,
               "Without labels: tissues by grey value alone, teeth are not looked for");
  command
      .option("--clicks", options->clicks,
              "JSON of what a person sees better: canal ends, numbers, teeth to join or divide (see README)")
      .valueNamed("FILE");
  command
      .option("--json", options->report,
              "What the source holds, what was found and said, seconds by stage: to this file")
      .valueNamed("REPORT");
  addDicomOptions(command, options->dicom);
  command
      .option("--scale", options->scale,
              "Grey values: hu, hu+1000, hu+1024 or AIR,MUSCLE,DENTINE [judged by their histogram]")
      .excludes(window);
  command.flag("--no-check", options->no_check,
               "Without the check page, which opens by itself on a terminal with a display");
  command.flag("--no-face", options->no_face, "Without the built-in face, which stands for lips, cheek and tongue");
  command.flag("--keep-face", options->choices.keep_face,
               "Keep the skin, by which the patient can be recognised, as the face");
  command.flag("--keep-age-band", options->choices.keep_age_band, "Keep the patient's age in decades, and sex");
  command.does([options] { return import(*options); });
}

}  // namespace app
