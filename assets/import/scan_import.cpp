#include "assets/import/scan_import.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>

#include "assets/import/lower_jaw.h"
#include "assets/import/mandibular_canal_line.h"
#include "assets/import/scan_scale.h"
#include "assets/import/tissue_from_grey.h"
#include "assets/import/tooth_site.h"
#include "assets/load_error.h"
#include "assets/scan/image_file.h"
#include "assets/scan/solid_fraction.h"
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

/// "DICM" after 128 bytes (PS3.10).
bool isDicom(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, 4> mark{};
  file.seekg(128);
  file.read(mark.data(), mark.size());
  return file && std::equal(mark.begin(), mark.end(), "DICM");
}

Sources sourcesAt(const std::string& source) {
  std::error_code error;
  const fs::file_status status = fs::status(source, error);
  if (!fs::exists(status)) throw LoadError(source + ": there is no such scan; check the name");
  const std::string dicom_advice = "DICOM is not read yet; export the scan as NRRD or NIfTI";
  if (!fs::is_directory(status)) {
    if (fs::is_regular_file(status) && isDicom(source)) throw LoadError(source + ": " + dicom_advice);
    return {source, std::nullopt, std::nullopt};
  }

  const auto ct = volumeNamed(source, "ct");
  if (ct) return {*ct, volumeNamed(source, "labels"), volumeNamed(source, "teeth")};
  for (const auto& entry : fs::directory_iterator(source, error))
    if (entry.is_regular_file(error) && (entry.path().extension() == ".dcm" || isDicom(entry.path())))
      throw LoadError(source + ": " + dicom_advice);
  throw LoadError(source +
                  ": it holds no ct.nrrd (or .nii.gz, .nii, .mha); name the volume so, or give the file itself");
}

/// Centroid of solid; throws for a scan without any.
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
    for (std::size_t value = kTissueCount; value < count.size(); ++value)
      if (count[value] > 0) foreign.push_back(value);
    if (!foreign.empty()) {
      std::string legend;
      for (std::size_t value = 1; value < kTissueCount; ++value)
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

}  // namespace

ImportedScan importScan(const std::string& source, const ScanImportOptions& options) {
  const Sources sources = sourcesAt(source);
  HounsfieldImage image = readHounsfield(sources.ct, options.window);
  ImportedScan imported;
  Patient& patient = imported.patient;
  patient.classification = options.classification;
  patient.ct.grid = image.grid;
  patient.ct.hounsfield = std::move(image.hounsfield);
  if (!options.window) imported.remarks = scaleRemarks(patient.ct.grid, patient.ct.hounsfield);
  if (!image.orientation_known)
    imported.remarks.push_back("the file states no orientation; assumed LPS (left-posterior-superior)");
  patient.ct.solid = classify(patient.ct.grid, patient.ct.hounsfield, options.classification);
  const glm::dvec3 centroid_P_mm = centroidOfSolid(patient.ct, sources.ct, options.classification.iso_hu);

  const Tissues tissues = readTissues(sources.labels, sources.ct, patient.ct, imported.remarks);
  if (sources.teeth)
    readTeeth(*sources.teeth, sources.ct, patient.ct, imported.remarks);
  else if (tissues == Tissues::labelled)
    numberLabelledTooth(options.tooth_fdi, patient.ct, imported.remarks);
  if (tissues == Tissues::labelled) labelPartialVoxels(patient.ct);
  patient.site = siteOf(patient.ct, options.tooth_fdi, source, imported.remarks);
  const auto near_P_mm = patient.site ? std::optional(patient.site->centre_P_mm) : std::nullopt;
  if (auto canal = mandibularCanalLine(patient.ct.grid, patient.ct.label, near_P_mm)) {
    patient.mandibular_canal_P_mm = std::move(canal->line_P_mm);
    patient.mandibular_canal_radius_mm = canal->radius_mm;
  }
  if (patient.site) {
    patient.jaw_P_mm = patient.site->centre_P_mm;
    patient.title = "imported scan, " + toothName(patient.site->fdi) + " (" + std::to_string(patient.site->fdi) + ")";
    return imported;
  }
  const auto jaw_P_mm = lowerJawCentre_P_mm(patient.ct, patient.mandibular_canal_P_mm);
  imported.remarks.push_back(jaw_P_mm ? "the view is centred on the lower jaw"
                                      : "no lower jaw found, the view is centred on all solid");
  patient.jaw_P_mm = jaw_P_mm.value_or(centroid_P_mm);
  patient.title = "imported scan, site unknown";
  return imported;
}

}  // namespace assets
