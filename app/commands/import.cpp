// `molar import SOURCE --out PATIENT` and `molar inspect SOURCE`: scans become patient folders, de-identified.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <utility>

#include <unistd.h>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "app/case/built_in_face.h"
#include "app/case/gutter_plan.h"
#include "app/check_page/check_picture.h"
#include "app/check_page/check_run.h"
#include "app/commands/command.h"
#include "app/commands/dicom_options.h"
#include "app/commands/dicom_report.h"
#include "app/commands/segmenter.h"
#include "app/commands/stop_signals.h"
#include "app/options/jaw_clicks_file.h"
#include "app/session/data_folder.h"
#include "app/station/patient_list.h"
#include "app/text/command_line.h"
#include "app/text/list.h"
#include "app/text/message.h"
#include "app/text/parse_number.h"
#include "app/text/usage_error.h"
#include "assets/import/modelled_gum.h"
#include "assets/import/scan_import.h"
#include "assets/import/tooth_site.h"
#include "assets/load_error.h"
#include "assets/patient/patient_folder.h"
#include "assets/patient/statement_file.h"
#include "assets/scenery/gingiva_surface.h"
#include "assets/tooth.h"
#include "calibration/output_file.h"

namespace app {
namespace {

struct ImportOptions {
  std::string source, out, window, scale, report, label_set, segment_with, clicks;
  DicomOptions dicom;
  assets::ScanImportOptions choices;
  bool no_face = false, force = false;
};

struct InspectOptions {
  std::string patient;
  DicomOptions dicom;
  bool json = false;
};

using Volumes_mm3 = std::array<double, assets::kTissueCount>;

Volumes_mm3 tissueVolumes(const assets::CtVolume& ct) {
  std::array<std::uint64_t, assets::kTissueCount> voxels{};
  for (const std::uint8_t label : ct.label) ++voxels[label < assets::kTissueCount ? label : 0];
  Volumes_mm3 volumes{};
  for (std::size_t l = 0; l < volumes.size(); ++l)
    volumes[l] = static_cast<double>(voxels[l]) * ct.grid.voxelVolume_mm3();
  return volumes;
}

double mandibularCanalLength_mm(const assets::Patient& patient) {
  double length = 0.0;
  for (std::size_t i = 1; i < patient.mandibular_canal_P_mm.size(); ++i)
    length += glm::distance(patient.mandibular_canal_P_mm[i - 1], patient.mandibular_canal_P_mm[i]);
  return length;
}

std::size_t triangles(const assets::MeshModel& model) {
  std::size_t count = 0;
  for (const assets::MeshPart& part : model.parts) count += part.triangles.size() / 3;
  return count;
}

nlohmann::json jsonOf(const assets::Patient& patient) {
  using nlohmann::json;
  const auto list = [](const auto& v) { return json{v.x, v.y, v.z}; };
  const assets::VolumeGrid& grid = patient.ct.grid;
  json tissues = json::object();
  const Volumes_mm3 volumes = tissueVolumes(patient.ct);
  for (std::size_t l = 1; l < volumes.size(); ++l) tissues[std::string(assets::kTissues[l].key)] = volumes[l];
  json out{{"title", patient.title},
           {"confirmed", !patient.isProposed()},
           {"size", list(grid.size)},
           {"spacing_mm", grid.spacing_mm},
           {"origin_P_mm", list(grid.origin_P_mm)},
           {"iso_hu", patient.classification.iso_hu},
           {"sigma_hu", patient.classification.sigma_hu},
           {"tissue_mm3", tissues},
           {"mandibular_canal",
            {{"points", patient.mandibular_canal_P_mm.size()},
             {"length_mm", mandibularCanalLength_mm(patient)},
             {"radius_mm", patient.mandibular_canal_radius_mm}}},
           {"gum_triangles", triangles(patient.gingiva)},
           {"gum", patient.has_modelled_gum        ? "modelled"
                   : patient.gingiva.parts.empty() ? "none"
                                                   : "labelled"},
           {"face_triangles", triangles(patient.face)},
           {"face", patient.has_built_in_face    ? "built-in"
                    : patient.face.parts.empty() ? "none"
                                                 : "own"}};
  json teeth = json::array();
  for (const auto& [fdi, volume_mm3] : assets::toothVolumes_mm3(patient.ct))
    teeth.push_back({{"fdi", fdi}, {"name", assets::toothName(fdi)}, {"volume_mm3", volume_mm3}});
  out["teeth"] = teeth;
  out["site"] = out["third_molar"] = nullptr;
  if (!patient.site) return out;
  const assets::OperativeSite& site = *patient.site;
  out["site"] = {{"fdi", site.fdi},
                 {"name", assets::toothName(site.fdi)},
                 {"centre_P_mm", list(site.centre_P_mm)},
                 {"axis_P", list(site.axis_P)}};
  // The name of before any tooth could be the site.
  if (assets::isThirdMolar(site.fdi))
    out["third_molar"] = {
        {"fdi", site.fdi}, {"centroid_P_mm", list(site.centre_P_mm)}, {"crown_direction_P", list(site.axis_P)}};
  return out;
}

std::string wordsOn(const assets::Patient& patient) {
  const assets::VolumeGrid& grid = patient.ct.grid;
  std::string text = fmt::format("patient      {}\nvolume       {} x {} x {} voxels of {:.3f} mm\n",
                                 patient.shownTitle(), grid.size.x, grid.size.y, grid.size.z, grid.spacing_mm);
  if (const auto& site = patient.site)
    text += fmt::format("site         FDI {}, {}, at ({:.1f}, {:.1f}, {:.1f}) mm\n", site->fdi,
                        assets::toothName(site->fdi), site->centre_P_mm.x, site->centre_P_mm.y, site->centre_P_mm.z);
  else
    text += "site         no third molar labelled here\n";
  for (const auto& [fdi, volume_mm3] : assets::toothVolumes_mm3(patient.ct))
    text += fmt::format("  tooth {}         {:9.1f} mm³\n", fdi, volume_mm3);
  const Volumes_mm3 volumes = tissueVolumes(patient.ct);
  for (std::size_t l = 1; l < volumes.size(); ++l)
    if (volumes[l] > 0.0) text += fmt::format("  {:16} {:9.1f} mm³\n", assets::kTissues[l].name, volumes[l]);
  if (!patient.mandibular_canal_P_mm.empty())
    text += fmt::format("canal        {:.1f} mm long, radius {:.1f} mm\n", mandibularCanalLength_mm(patient),
                        patient.mandibular_canal_radius_mm);
  if (patient.has_modelled_gum)
    text += fmt::format("gum          modelled, {:g} mm over the bone: not the patient's\n", assets::kGumThickness_mm);
  text += patient.has_built_in_face    ? "face         built-in, placed by the lower teeth: not the patient's\n"
          : patient.face.parts.empty() ? "face         none\n"
                                       : "face         the patient's\n";
  return text;
}

constexpr std::array kSeals = {"none", "broken", "of another machine", "of this machine"};

nlohmann::json jsonOf(const assets::StatementFacts& statement) {
  return {{"reviewed", statement.is_reviewed},
          {"signature", kSeals[static_cast<std::size_t>(statement.seal)]},
          {"of_this_volume", statement.is_of_volume}};
}

std::string wordsOn(const assets::StatementFacts& statement) {
  return fmt::format("identity     removed by software, {}; statement {}, signature {}\n",
                     statement.is_reviewed ? "pictures reviewed by a person"
                                           : "not reviewed (molar check PATIENT --pictures-reviewed)",
                     statement.is_of_volume ? "of this volume" : "of another volume",
                     kSeals[static_cast<std::size_t>(statement.seal)]);
}

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

/// How long each stage of the segmentation took. On a terminal its name stands there meanwhile.
class StageClock {
 public:
  void begin(std::string_view stage) {
    end();
    stage_ = stage;
    begun_ = std::chrono::steady_clock::now();
    if (on_terminal_) std::fprintf(stderr, "\r\033[K  finding: %s", stage_.c_str());
  }
  void end() {
    if (stage_.empty()) return;
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun_;
    stages_.push_back({{"stage", std::exchange(stage_, {})}, {"seconds", took.count()}});
    if (on_terminal_) std::fputs("\r\033[K", stderr);
  }
  const nlohmann::json& stages() const { return stages_; }

 private:
  bool on_terminal_ = isatty(STDERR_FILENO) == 1;
  std::string stage_;
  std::chrono::steady_clock::time_point begun_;
  nlohmann::json stages_ = nlohmann::json::array();
};

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

/// A DICOM source is surveyed before; its path may name a person and is said nowhere. The report is written whether it
/// is refused or not.
assets::ImportedScan importDicom(const ImportOptions& options, nlohmann::json& report) {
  SurveyedSource source = surveySource(options.source, options.dicom);
  assets::DicomSurvey& survey = source.survey;
  try {
    assets::ImportedScan imported = assets::importScan(survey, options.choices);
    report = nlohmann::json::parse(dicomReportJson(survey));
    for (const assets::DicomVerdict& verdict : survey.verdicts) printMessage(assets::lineOf(verdict));
    return imported;
  } catch (const assets::LoadError&) {
    report = nlohmann::json::parse(dicomReportJson(survey));
    throw;
  }
}

assets::ImportedScan importFile(const ImportOptions& options, nlohmann::json& report) {
  report = {{"kind", "volume"}, {"verdicts", nlohmann::json::array()}};
  try {
    return assets::importScan(options.source, options.choices);
  } catch (const assets::JawRefused& refused) {
    report["verdicts"].push_back(
        {{"code", refused.refusal.code}, {"sentence", refused.refusal.sentence}, {"stops", true}});
    throw;
  }
}

assets::ImportedScan importAny(ImportOptions& options) {
  // Whether it can be written, before the work.
  if (!options.report.empty()) calibration::OutputFile(options.report, options.force);
  nlohmann::json report;
  StageClock clock;
  options.choices.stage = [&clock](std::string_view stage) { clock.begin(stage); };
  const auto write = [&] {
    clock.end();
    if (report.is_null()) return;
    report["stages"] = clock.stages();
    if (!options.report.empty()) calibration::OutputFile(options.report, options.force).commit(report.dump(2) + "\n");
  };
  const bool is_dicom = isDicomOrServer(options.source, options.dicom);
  try {
    assets::ImportedScan imported = is_dicom ? importDicom(options, report) : importFile(options, report);
    report["jaw"] = imported.jaw ? jsonOf(*imported.jaw) : nlohmann::json(nullptr);
    write();
    for (const std::string& remark : imported.remarks)
      printMessage((is_dicom ? "scan" : options.source) + ": " + remark);
    return imported;
  } catch (const assets::LoadError&) {
    write();
    throw;
  }
}

/// As `molar check` finds it, without the folders above: they can be named after a person.
std::string nameOf(const std::string& folder) {
  const std::filesystem::path path = std::filesystem::path(folder).lexically_normal();
  return (path.has_filename() ? path : path.parent_path()).filename().string();
}

constexpr const char* kStopped = "import: stopped, nothing was imported";
constexpr std::string_view kStoppedLine = "molar: import: stopped, nothing was imported\n";

int import(ImportOptions options) {
  if (const auto fdi = options.choices.tooth_fdi; fdi && !assets::isToothNumber(*fdi))
    throw UsageError("--tooth " + std::to_string(*fdi) + ": not an FDI number, give 11 to 48 or 51 to 85");
  if (const auto named = std::ranges::find(assets::kLabelSets, options.label_set); named != assets::kLabelSets.end())
    options.choices.label_set = static_cast<assets::LabelSet>(named - assets::kLabelSets.begin());
  std::optional<Segmenter> segmenter;
  if (!options.segment_with.empty()) {
    if (options.choices.labels)
      throw UsageError("--labels " + *options.choices.labels + ": the map is made by --segment-with, give one of them");
    segmenter.emplace(options.segment_with);
    options.choices.segment = [&segmenter](const assets::VolumeGrid& grid, const std::vector<std::int16_t>& grey) {
      return segmenter->labels(grid, grey);
    };
  }
  if (!options.clicks.empty()) options.choices.clicks = readJawClicks(options.clicks);
  if (!options.scale.empty()) options.choices.scale = scaleOf(options.scale);
  if (!options.window.empty()) options.choices.window = windowOf(options.window);
  const bool has_no_place = options.out.empty();
  if (has_no_place) {
    makeDataFolder(usualPatientFolder());
    const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
    options.out = newPatientPath(usualPatientFolder(), now.time_since_epoch().count());
  }
  auto at_once = std::make_unique<StopsWithALine>(kStoppedLine);
  assets::ImportedScan imported = importAny(options);
  assets::Patient& patient = imported.patient;
  patient.gingiva = assets::gingivaSurface(patient.ct, planGutter(patient, kUsualBurRadius_mm));
  if (options.choices.keep_face && !options.no_face && !placeOwnFace(patient))
    printMessage("the scan shows too little skin for a face");
  if (!options.no_face && patient.site && patient.face.parts.empty())
    if (const std::string why_not = placeBuiltInFace(patient); !why_not.empty())
      printMessage("without a face: " + why_not);
  at_once.reset();
  const StopSignals signals;
  assets::savePatient(patient, options.out, options.force, imported.origin ? &*imported.origin : nullptr,
                      options.choices.clicks.isEmpty() ? "" : jawClicksText(options.choices.clicks), [&] {
                        if (signals.isAsked()) throw UsageError(kStopped);
                      });
  // Edits of another import of this folder.
  std::error_code ignored;
  std::filesystem::remove(checkLogPath(options.out), ignored);
  if (imported.jaw) keepCheckPicture(patient, options.out);
  std::fputs(wordsOn(patient).c_str(), stderr);
  if (patient.isProposed()) printMessage("look at what was found: molar check " + nameOf(options.out));
  if (has_no_place)
    printMessage("imported as " + std::filesystem::path(options.out).filename().string() + ", in " +
                 usualPatientFolder().string() + ": rename the folder as you like; molar start offers it");
  return 0;
}

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
  if (options.json) {
    nlohmann::json out = jsonOf(patient);
    out["deidentified"] = statement ? jsonOf(*statement) : nlohmann::json(nullptr);
    std::fputs((out.dump(2) + "\n").c_str(), stdout);
  } else {
    std::fputs((wordsOn(patient) + (statement ? wordsOn(*statement) : std::string())).c_str(), stdout);
  }
  return 0;
}

}  // namespace

void addImport(CommandLine& molar) {
  auto options = std::make_shared<ImportOptions>();
  CommandLine& command = molar.command("import", "A scan becomes a patient folder, de-identified");
  command
      .option(
          "SOURCE", options->source,
          "Folder of DICOM files; https://HOST/PATH of DICOMweb or dicom://HOST:PORT/AETITLE, with --find; folder with "
          "ct.nrrd, labels.nrrd and teeth.nrrd; or one volume file")
      .required();
  command.option("--out", options->out,
                 "Patient folder to write [a new one in the data folder, which molar start offers]");
  command.option("--iso", options->choices.classification.iso_hu, "Grey value of the bone's surface, HU")
      .from(-1000.0, 4000.0)
      .showsDefault();
  command.option("--sigma", options->choices.classification.sigma_hu, "Width of the soft transition, HU")
      .from(1.0, 2000.0)
      .showsDefault();
  command.option("--tooth", options->choices.tooth_fdi, "FDI number of the operated tooth [the third molar]");
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
  command.flag("--no-face", options->no_face, "Without the built-in face, which stands for lips, cheek and tongue");
  command.flag("--keep-face", options->choices.keep_face,
               "Keep the skin, by which the patient can be recognised, as the face");
  command.flag("--keep-age-band", options->choices.keep_age_band, "Keep the patient's age in decades, and sex");
  command.does([options] { return import(*options); });
}

void addInspect(CommandLine& molar) {
  auto options = std::make_shared<InspectOptions>();
  CommandLine& command = molar.command("inspect", "What a patient folder, a DICOM folder or a server's study holds");
  command.option("PATIENT", options->patient, kPatientHelp).required();
  command.flag("--json", options->json, "For programs");
  addDicomOptions(command, options->dicom);
  command.does([options] { return inspect(*options); });
}

}  // namespace app
