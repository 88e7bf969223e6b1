#include "assets/import/scan_import.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <span>

#include "assets/import/dicom/burnt_in_text.h"
#include "assets/import/dicom/dicom_volume.h"
#include "assets/import/dicom/stored_frame.h"
#include "assets/import/foreign_labels.h"
#include "assets/import/found_jaw.h"
#include "assets/import/grey_scale.h"
#include "assets/import/lower_jaw.h"
#include "assets/import/mandibular_canal_line.h"
#include "assets/import/scan_scale.h"
#include "assets/import/shading.h"
#include "assets/import/soft_tissue_removal.h"
#include "assets/import/tissue_from_grey.h"
#include "assets/import/tooth_site.h"
#include "assets/load_error.h"
#include "assets/scan/image_file.h"
#include "assets/scan/resampling.h"
#include "assets/scan/solid_fraction.h"
#include "assets/segment/voxel_edits.h"
#include "assets/tooth.h"

namespace assets {

namespace {

namespace fs = std::filesystem;

struct Sources {
  std::string ct;
  std::optional<std::string> labels, teeth;
};

/// The file of that name in any supported format; throws if there is more than one.
std::optional<std::string> volumeNamed(const fs::path& folder, const std::string& name) {
  std::optional<std::string> found;
  for (const char* extension : {".nrrd", ".nhdr", ".nii.gz", ".nii", ".mha", ".mhd"}) {
    const fs::path path = folder / (name + extension);
    std::error_code error;
    if (!fs::exists(path, error)) continue;
    if (found) throw LoadError(folder.string() + ": it holds more than one volume named '" + name + "'; leave one");
    found = path.string();
  }
  return found;
}

Sources sourcesAt(const std::string& source) {
  std::error_code error;
  const fs::file_status status = fs::status(source, error);
  if (!fs::exists(status)) throw LoadError(source + ": there is no such scan; check the name");
  if (!fs::is_directory(status)) return {source, std::nullopt, std::nullopt};
  const auto ct = volumeNamed(source, "ct");
  if (ct) return {*ct, volumeNamed(source, "labels"), volumeNamed(source, "teeth")};
  throw LoadError(source +
                  ": it holds neither DICOM pictures nor a ct.nrrd (or .nii.gz, .nii, .mha); name the volume "
                  "so, or give the file itself");
}

/// Centroid of solid; throws for a scan without any.
/// What soft tissue lies near to, whatever the surface that is to be drawn.
constexpr double kBone_hu = 300.0;

glm::dvec3 centroidOfSolid(const CtVolume& ct, const std::string& path, double iso_hu) {
  constexpr double kMin_mm3 = 10.0;
  const auto [count, sum] = voxelSum(ct.grid, [&](std::size_t v) { return ct.solid[v] >= kHalfSolid; });
  if (count * ct.grid.voxelVolume_mm3() < kMin_mm3)
    throw LoadError(path + ": less than 10 mm3 of it is above " + std::to_string(static_cast<int>(iso_hu)) +
                    " HU; give a CT in Hounsfield, or another --iso");
  return ct.grid.origin_P_mm + ct.grid.spacing_mm * sum / count;
}

/// Labels or teeth on the grid of the CT.
std::vector<std::uint8_t> valuesOn(const VolumeGrid& grid, const std::string& path, const std::string& ct) {
  ByteImage image = readLabels(path);
  if (!isSameGrid(image.grid, grid))
    throw LoadError(path + ": its grid differs from that of " + ct + "; export both on the same grid");
  return std::move(image.values);
}

/// "4, 17"; empty without numbers.
template <class Numbers>
std::string listOf(const Numbers& numbers) {
  std::string list;
  for (const auto number : numbers) list += (list.empty() ? "" : ", ") + std::to_string(number);
  return list;
}

enum class Tissues { labelled, estimated };

/// Labels of the file, or estimated from grey values.
Tissues readTissues(const std::optional<std::string>& labels, const std::string& ct_path, CtVolume& ct,
                    std::vector<std::string>& remarks) {
  if (labels) {
    ct.label = valuesOn(ct.grid, *labels, ct_path);
    const auto count = countsOf(ct.label);
    std::vector<std::size_t> foreign;
    for (std::size_t value = kScanTissueCount; value < count.size(); ++value)
      if (count[value] > 0) foreign.push_back(value);
    if (!foreign.empty()) {
      std::string legend;
      for (std::size_t value = 1; value < kScanTissueCount; ++value)
        legend += std::to_string(value) + " " + std::string(kTissues[value].name) + ", ";
      throw LoadError(*labels + ": unknown label " + listOf(foreign) + "; use " + legend + "and 0 for everything else");
    }
    if (count[0] < ct.label.size()) return Tissues::labelled;
    remarks.push_back("labels: all are 0; tissues are estimated from grey values");
  }
  ct.label = labelsFromGrey(ct.grid, ct.hounsfield);
  return Tissues::estimated;
}

/// Tooth numbers of the file.
void readTeeth(const std::string& teeth, const std::string& ct_path, CtVolume& ct, std::vector<std::string>& remarks) {
  ct.tooth = valuesOn(ct.grid, teeth, ct_path);
  const auto count = countsOf(ct.tooth);
  for (std::size_t value = 1; value < count.size(); ++value)
    if (count[value] > 0 && !isToothNumber(static_cast<int>(value)))
      throw LoadError(teeth + ": its value " + std::to_string(value) +
                      " is not an FDI number; use 11 to 48, 51 to 85, and 0 outside teeth");
  if (count[0] == ct.tooth.size()) remarks.push_back("teeth: no tooth is numbered, all are 0");
  labelNumberedTeeth(ct);
}

/// Labels without numbers: a single labelled tooth is a third molar.
void numberLabelledTooth(const std::optional<int>& requested_fdi, CtVolume& ct, std::vector<std::string>& remarks) {
  const ThirdMolar molar = numberThirdMolar(ct, requested_fdi);
  if (molar == ThirdMolar::too_large)
    remarks.push_back("labels: enamel, dentine and pulp (4 to 6) fill " +
                      std::to_string(std::lround(labelledTeeth_mm3(ct))) +
                      " mm3, more than one tooth; number the teeth in teeth.nrrd, or check the label values");
  if (molar == ThirdMolar::of_unknown_side)
    remarks.push_back(
        "labels: nothing in front of the tooth shows whether it is right or left; give --tooth 48 or --tooth 38");
}

/// The requested tooth, or a third molar, lower ones first.
std::optional<OperativeSite> siteOf(const CtVolume& ct, const std::optional<int>& requested_fdi,
                                    const std::string& source, std::vector<std::string>& remarks) {
  const std::vector<int> teeth = siteCandidates(ct);
  if (requested_fdi) {
    if (const auto site = siteAtTooth(ct, *requested_fdi)) return site;
    throw LoadError(source + ": tooth " + std::to_string(*requested_fdi) + " is not labelled in it, " +
                    (teeth.empty() ? "nor is any other; give its number in teeth.nrrd"
                                   : "these are: " + listOf(teeth) + "; choose one with --tooth"));
  }
  std::optional<OperativeSite> site;
  for (const int fdi : {48, 38, 28, 18}) {
    if (std::ranges::find(teeth, fdi) == teeth.end()) continue;
    if (!site)
      site = siteAtTooth(ct, fdi);
    else
      remarks.push_back("tooth " + std::to_string(fdi) + " is labelled too; --tooth " + std::to_string(fdi) +
                        " selects it as the site");
  }
  if (site) return site;
  remarks.push_back(
      "no third molar is labelled" +
      (teeth.empty() ? std::string() : "; these teeth are: " + listOf(teeth) + ", --tooth selects one as the site"));
  return std::nullopt;
}

/// A scan's grey values with what lies beside them; `name` stands for it in messages.
struct Volume {
  HounsfieldImage image;
  std::string name;
  std::optional<std::string> labels, teeth;
};

/// Smaller scans are a part of a jaw.
bool isToSegment(const Volume& volume, const ScanImportOptions& options) {
  return !options.grey_only && !options.segment && !options.labels && !volume.labels && !volume.teeth &&
         canHoldJaw(volume.image.grid);
}

/// Jaw and teeth of a scan without labels; hard tissue elsewhere by grey value.
FoundJaw findJaw(const std::string& name, const ScanImportOptions& options, CtVolume& ct) {
  if (options.stage) options.stage("shading");
  JawSegmentation found = segmentJaw(ct.grid, greyToSearch(ct), options.stage, options.clicks, options.so_far);
  if (found.refusal) throw JawRefused(name, *found.refusal);
  applyVoxelEdits({ct.grid, ct.hounsfield}, options.clicks.voxels, found);
  return takeLabels(std::move(found), ct);
}

/// What a person must see before it counts.
void remarkProposals(const Patient& patient, const FoundJaw& jaw, const CanalProposal* proposed,
                     std::vector<std::string>& remarks) {
  const std::string tooth =
      patient.site && !isTold(jaw, patient.site->fdi) ? "tooth " + std::to_string(patient.site->fdi) : "";
  const std::string canal = proposed != nullptr && !proposed->is_confirmed ? "the mandibular canal" : "";
  const std::string what = tooth + (tooth.empty() || canal.empty() ? "" : " and ") + canal;
  if (!what.empty())
    remarks.push_back(what + " " + (tooth.empty() || canal.empty() ? "was" : "were") +
                      " found by the program and not confirmed: molar check PATIENT shows, corrects and confirms "
                      "them");
  if (proposed == nullptr) remarks.push_back("no mandibular canal was found on the side of the site");
  const auto spare = std::ranges::count(jaw.teeth, 0, &FoundTooth::fdi);
  if (spare > 0)
    remarks.push_back(std::to_string(spare) + (spare == 1 ? " dense piece fits" : " dense pieces fit") +
                      " no tooth's number and have none");
}

/// Why no teeth are looked for.
std::string partRemark(const VolumeGrid& grid) {
  const double narrowest_mm = grid.spacing_mm * std::min({grid.size.x, grid.size.y, grid.size.z});
  return "the scan is " + std::to_string(std::lround(narrowest_mm)) + " mm at its narrowest: below " +
         std::to_string(std::lround(kLeastJaw_mm)) +
         " mm no teeth are looked for, its tissues are told by grey values alone";
}

ImportedScan patientOf(Volume volume, std::vector<std::string> remarks, const ScanImportOptions& options) {
  ImportedScan imported;
  imported.remarks = std::move(remarks);
  Patient& patient = imported.patient;
  patient.classification = options.classification;
  patient.ct.grid = volume.image.grid;
  patient.ct.hounsfield = std::move(volume.image.hounsfield);
  if (!options.window)
    for (std::string& remark : scaleRemarks(patient.ct.grid, patient.ct.hounsfield))
      imported.remarks.push_back(std::move(remark));
  if (!volume.image.orientation_known)
    imported.remarks.push_back("the file states no orientation; assumed LPS (left-posterior-superior)");
  patient.ct.solid = classify(patient.ct.grid, patient.ct.hounsfield, options.classification);
  const glm::dvec3 centroid_P_mm = centroidOfSolid(patient.ct, volume.name, options.classification.iso_hu);

  if (!options.clicks.isEmpty() && !isToSegment(volume, options))
    throw LoadError(volume.name + ": clicks change what is found in a whole scan without labels; leave --clicks out");
  const std::optional<std::string> foreign =
      options.segment ? std::optional(options.segment(patient.ct.grid, patient.ct.hounsfield)) : options.labels;
  Tissues tissues = Tissues::labelled;
  if (foreign) {
    const LabelTable table = foreignLabelTable(*foreign, options.label_set);
    for (std::string& remark : takeForeignLabels(*foreign, table, patient.ct))
      imported.remarks.push_back(std::move(remark));
  } else if (isToSegment(volume, options)) {
    imported.jaw = findJaw(volume.name, options, patient.ct);
  } else {
    if (!options.grey_only && !volume.labels && !volume.teeth && !canHoldJaw(patient.ct.grid))
      imported.remarks.push_back(partRemark(patient.ct.grid));
    tissues = readTissues(volume.labels, volume.name, patient.ct, imported.remarks);
  }
  if (volume.teeth)
    readTeeth(*volume.teeth, volume.name, patient.ct, imported.remarks);
  else if (!imported.jaw && tissues == Tissues::labelled && patient.ct.tooth.empty())
    numberLabelledTooth(options.tooth_fdi, patient.ct, imported.remarks);
  if (tissues == Tissues::labelled) labelPartialVoxels(patient.ct);
  patient.site = siteOf(patient.ct, options.tooth_fdi, volume.name, imported.remarks);
  const auto near_P_mm = patient.site ? std::optional(patient.site->centre_P_mm) : std::nullopt;
  if (imported.jaw) {
    // Where it has none on the site's side, what is labelled is the other side's proposal.
    takeCanal(*imported.jaw, patient);
    patient.has_modelled_gum = imported.jaw->has_gum;
    remarkProposals(patient, *imported.jaw, canalBeside(imported.jaw->canals, patient.site), imported.remarks);
  } else if (auto canal = mandibularCanalLine(patient.ct.grid, patient.ct.label, near_P_mm)) {
    patient.mandibular_canal_P_mm = std::move(canal->line_P_mm);
    patient.mandibular_canal_radius_mm = canal->radius_mm;
  }
  patient.title = titleOf(patient.site);
  if (patient.site) {
    patient.jaw_P_mm = patient.site->centre_P_mm;
    return imported;
  }
  const auto jaw_P_mm = lowerJawCentre_P_mm(patient.ct, patient.mandibular_canal_P_mm);
  imported.remarks.push_back(jaw_P_mm ? "the view is centred on the lower jaw"
                                      : "no lower jaw found, the view is centred on all solid");
  patient.jaw_P_mm = jaw_P_mm.value_or(centroid_P_mm);
  return imported;
}

std::string placesOf(const std::vector<GreyPeak>& peaks) {
  if (peaks.empty()) return "no peak";
  std::string list;
  for (const GreyPeak& peak : peaks) list += (list.empty() ? "" : ", ") + std::to_string(std::lround(peak.grey));
  return (peaks.size() == 1 ? "one peak at " : "peaks at ") + list;
}

std::string noScaleSentence(const GreyJudgement& judged) {
  return "grey values follow no known scale (" + placesOf(judged.peaks) +
         "); show Molar three places: --scale AIR,MUSCLE,DENTINE, the grey values there";
}

/// What was made of grey values that are not Hounsfield; empty where they are.
std::string scaleSentence(const GreyMap& map, const std::vector<GreyPeak>& peaks) {
  const std::string formula = "HU = " + shortNumber(map.slope, 3) + " x grey value " +
                              (map.offset_hu < 0.0 ? "- " : "+ ") + shortNumber(std::abs(map.offset_hu), 0);
  if (map.scale == GreyScale::shifted)
    return "grey values are stored higher than Hounsfield without saying so: " + formula;
  if (map.scale == GreyScale::two_points)
    return "grey values are not Hounsfield (" + placesOf(peaks) + "); mapped by air and soft tissue: " + formula +
           "; --scale AIR,MUSCLE,DENTINE states it better";
  return {};
}

/// Slices farther apart show no roots (as of DICOM, dicom_survey.cpp).
constexpr double kTooCoarseScan_mm = 1.5;

/// The scale that the owner states, or the one that the values show; none where they show none.
GreyJudgement scaleOf(std::span<const std::int16_t> grey, const std::optional<GreyMap>& stated) {
  return stated ? GreyJudgement{stated, {}} : judgeGreyScale(grey, kNoGrey);
}

/// Calibrated scanners have no shading to speak of, and their values stay as they are. HU that were taken away.
double flattenUncalibrated(const GreyMap& map, HounsfieldImage& image) {
  const bool is_calibrated = map.scale == GreyScale::hounsfield || map.scale == GreyScale::shifted;
  return is_calibrated ? 0.0 : flattenShading(image.grid, image.hounsfield);
}

/// A file is in Hounsfield, unless its owner states another scale. One without labels need not be: then its scale is
/// judged. Throws for what cannot be segmented.
void takeScale(Volume& volume, const ScanImportOptions& options, std::vector<std::string>& remarks) {
  const bool is_judged = isToSegment(volume, options);
  if (is_judged && volume.image.coarsest_mm > kTooCoarseScan_mm)
    throw JawRefused(volume.name, {"R1", "slices are " + shortNumber(volume.image.coarsest_mm, 1) +
                                             " mm apart; below 1 mm a third molar cannot be rehearsed"});
  if (options.window || (!is_judged && !options.scale)) return;
  std::vector<std::int16_t>& grey = volume.image.hounsfield;
  const GreyJudgement judged = scaleOf(grey, options.scale);
  if (!judged.map) throw JawRefused(volume.name, {"V1", noScaleSentence(judged)});
  applyGreyMap(*judged.map, kNoGrey, grey);
  std::ranges::replace(grey, kNoGrey, kAirHu);
  flattenUncalibrated(*judged.map, volume.image);
  if (std::string said = scaleSentence(*judged.map, judged.peaks); !said.empty()) remarks.push_back(std::move(said));
}

}  // namespace

ImportedScan importScan(const std::string& source, const ScanImportOptions& options) {
  const Sources sources = sourcesAt(source);
  Volume volume{readHounsfield(sources.ct, options.window), sources.ct, sources.labels, sources.teeth};
  std::vector<std::string> remarks;
  takeScale(volume, options, remarks);
  if (options.grey) options.grey(volume.image.grid, volume.image.hounsfield);
  return patientOf(std::move(volume), std::move(remarks), options);
}

namespace {

/// The values of the headers that may be kept.
ScanOrigin originOf(const DicomSurvey& survey, const ScanImportOptions& options) {
  const DicomSeries& series = survey.sorted.series[*survey.taken];
  const DicomPlan& plan = *survey.plan;
  const DicomHeader& header = survey.folder.files[series.slices.front().file].header;
  ScanOrigin origin;
  origin.modality = header.modality, origin.manufacturer = header.manufacturer;
  origin.model = header.model, origin.kernel = header.kernel;
  origin.tube_kv = header.tube_kv, origin.exposure_mas = header.exposure_mas;
  origin.year_band = header.year_band;
  if (options.keep_age_band) origin.age_decade = header.age_decade, origin.sex = header.sex;
  origin.columns = series.columns, origin.rows = series.rows;
  origin.slices = static_cast<int>(plan.stack.order.size());
  origin.row_spacing_mm = glm::length(plan.geometry.step_P_mm[1]);
  origin.column_spacing_mm = glm::length(plan.geometry.step_P_mm[0]);
  origin.step_mm = plan.stack.step_mm, origin.tilt_deg = plan.stack.tilt_deg;
  origin.bridged_slices = static_cast<int>(plan.invented_slices);
  origin.has_face = options.keep_face;
  origin.files = static_cast<int>(survey.folder.files.size());
  // Of what reaches the patient.
  for (const DicomSlice& slice : series.slices)
    origin.has_burnt_in_text_checked =
        origin.has_burnt_in_text_checked || survey.folder.files[slice.file].header.has_burnt_in_text;
  for (const DicomFile& file : survey.folder.files) {
    for (std::size_t group = 0; group < kDroppedGroups.size(); ++group)
      origin.dropped_elements[group] += file.header.dropped_elements[group];
  }
  return origin;
}

/// Says what was judged. Throws LoadError: there is no scale.
GreyMap greyMapOf(DicomSurvey& survey, std::span<const std::int16_t> grey, const std::optional<GreyMap>& stated) {
  const GreyJudgement judged = scaleOf(grey, stated);
  if (!judged.map) {
    survey.verdicts.push_back({"V1", noScaleSentence(judged), {}, true});
    throw LoadError(lineOf(survey.verdicts.back()));
  }
  if (std::string said = scaleSentence(*judged.map, judged.peaks); !said.empty())
    survey.verdicts.push_back({"V2", std::move(said), {}, false});
  return *judged.map;
}

}  // namespace

ImportedScan importScan(DicomSurvey& survey, const ScanImportOptions& options) {
  const std::string name = "scan";
  if (options.stage) options.stage("pictures");
  std::vector<std::int16_t> grey = readDicomVolume(survey);
  if (options.stage) options.stage("grey values");
  const std::vector<TextBox> text = burntInText(survey.plan->geometry.size, grey, kNoGrey);
  blankText(survey.plan->geometry.size, text, kNoGrey, grey);
  if (!text.empty())
    survey.verdicts.push_back(
        {"B2",
         counted(text.size(), "line") + " of text in the pictures " + (text.size() == 1 ? "was" : "were") + " blanked",
         {},
         false});
  const GreyMap map = greyMapOf(survey, grey, options.scale);
  applyGreyMap(map, kNoGrey, grey);
  std::ranges::replace(grey, kNoGrey, kAirHu);
  const Resampling resampling(survey.plan->geometry, name);
  HounsfieldImage image{resampling.grid(), resampling.linear(std::move(grey), kAirHu)};
  if (options.grey) options.grey(image.grid, image.hounsfield);
  ScanOrigin origin = originOf(survey, options);
  origin.blanked_text_lines = static_cast<int>(text.size());
  origin.scale = map.scale, origin.slope = map.slope, origin.offset_hu = map.offset_hu;
  origin.shading_hu = flattenUncalibrated(map, image);
  std::vector<std::string> remarks;
  if (!options.keep_face) {
    const double removed_mm3 = removeDistantSoftTissue(image.grid, image.hounsfield, kBone_hu);
    origin.removed_soft_tissue_cm3 = removed_mm3 / 1000.0;
    if (removed_mm3 >= 1000.0)
      remarks.push_back(std::to_string(std::lround(removed_mm3 / 1000.0)) +
                        " cm3 of soft tissue farther than 12 mm from bone were removed, so that no face is left; "
                        "--keep-face keeps them");
  }
  try {
    ImportedScan imported =
        patientOf({std::move(image), name, std::nullopt, std::nullopt}, std::move(remarks), options);
    imported.origin = std::move(origin);
    return imported;
  } catch (const JawRefused& refused) {
    survey.verdicts.push_back({refused.refusal.code, refused.refusal.sentence, {}, true});
    throw;
  }
}

bool isDicomSource(const std::string& source) {
  std::error_code error;
  if (!fs::exists(source, error)) return false;
  if (fs::is_directory(source, error) && volumeNamed(source, "ct")) return false;
  return holdsDicom(source);
}

}  // namespace assets
