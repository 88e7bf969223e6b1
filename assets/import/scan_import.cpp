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

/// The file of that name in any format we read; more than one is a question we do not guess at.
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

/// Middle of what is drawn; refuses a scan of which nothing would be seen.
glm::dvec3 middleOfSolid(const CtVolume& ct, const std::string& path, double iso_hu) {
  constexpr std::uint8_t kHalf = 128;
  constexpr double kLeast_mm3 = 10.0;
  const auto [count, sum] = voxelSum(ct.grid, [&](std::size_t v) { return ct.solid[v] >= kHalf; });
  if (count * ct.grid.voxelVolume_mm3() < kLeast_mm3)
    throw LoadError(path + ": less than 10 mm3 of it is above " + std::to_string(static_cast<int>(iso_hu)) +
                    " HU; give a CT in Hounsfield, or another --iso");
  return ct.grid.origin_P_mm + ct.grid.spacing_mm * sum / count;
}

/// Labels or teeth on the grid of the CT.
std::vector<std::uint8_t> valuesOn(const VolumeGrid& grid, const std::string& path, const std::string& ct) {
  ByteImage image = readLabels(path);
  if (!isSameGrid(image.grid, grid))
    throw LoadError(path + ": its voxels do not lie where those of " + ct + " do; export both on the same grid");
  return std::move(image.values);
}

std::array<std::size_t, 256> countsOf(const std::vector<std::uint8_t>& values) {
  std::array<std::size_t, 256> count{};
  for (const std::uint8_t value : values) ++count[value];
  return count;
}

/// "4, 17", or none.
template <class Numbers>
std::string listOf(const Numbers& numbers) {
  std::string list;
  for (const auto number : numbers) list += (list.empty() ? "" : ", ") + std::to_string(number);
  return list;
}

enum class Tissues { labelled, guessed };

/// Labels as they stand in the file if they are ours, else guessed from grey values.
Tissues readTissues(const std::optional<std::string>& labels, const std::string& ct_path, CtVolume& ct,
                    std::vector<std::string>& remarks) {
  if (labels) {
    ct.label = valuesOn(ct.grid, *labels, ct_path);
    const auto count = countsOf(ct.label);
    std::vector<std::size_t> foreign;
    for (std::size_t value = kTissueCount; value < count.size(); ++value)
      if (count[value] > 0) foreign.push_back(value);
    if (!foreign.empty())
      throw LoadError(*labels + ": its value" +
                      (foreign.size() > 1 ? "s " + listOf(foreign) + " are" : " " + listOf(foreign) + " is") +
                      " none of ours; give 1 cortical, 2 trabecular, 3 undivided teeth, 4 enamel, 5 dentine, 6 pulp, 7 "
                      "mandibular canal, 8 ligament, 9 gingiva, and 0 for all else");
    if (count[0] < ct.label.size()) return Tissues::labelled;
    remarks.push_back("labels: all are 0; tissues are guessed from grey values");
  }
  ct.label = labelsFromGrey(ct.grid, ct.hounsfield);
  return Tissues::guessed;
}

/// Which tooth each voxel belongs to, as the file has it.
void readTeeth(const std::string& teeth, const std::string& ct_path, CtVolume& ct, std::vector<std::string>& remarks) {
  ct.tooth = valuesOn(ct.grid, teeth, ct_path);
  const auto count = countsOf(ct.tooth);
  for (std::size_t value = 1; value < count.size(); ++value)
    if (count[value] > 0 && !isToothNumber(static_cast<int>(value)))
      throw LoadError(teeth + ": its value " + std::to_string(value) +
                      " is no FDI number of a tooth; give 11 to 48, 51 to 85, and 0 where there is none");
  if (count[0] == ct.tooth.size()) remarks.push_back("teeth: no tooth is told apart, all are 0");
  labelNumberedTeeth(ct);
}

/// Labels without numbers: one marked tooth is a third molar.
void takeMarkedTooth(const std::optional<int>& asked_fdi, CtVolume& ct, std::vector<std::string>& remarks) {
  const ThirdMolar molar = numberThirdMolar(ct, asked_fdi);
  if (molar == ThirdMolar::too_large)
    remarks.push_back("labels: enamel, dentine and pulp (4 to 6) fill " +
                      std::to_string(std::lround(labelledTeeth_mm3(ct))) +
                      " mm3, more than one tooth; tell teeth apart in teeth.nrrd, or check the legend");
  if (molar == ThirdMolar::of_unknown_side)
    remarks.push_back(
        "labels: nothing in front of the tooth says whether it is a right or a left one; --tooth 48 or "
        "--tooth 38 says it");
}

/// The tooth asked for, or the third molar: lower ones first, as they are operated most.
std::optional<OperativeSite> siteOf(const CtVolume& ct, const std::optional<int>& asked_fdi, const std::string& source,
                                    std::vector<std::string>& remarks) {
  const std::vector<int> teeth = siteCandidates(ct);
  if (asked_fdi) {
    if (const auto site = siteAtTooth(ct, *asked_fdi)) return site;
    throw LoadError(source + ": tooth " + std::to_string(*asked_fdi) + " is not labelled in it, " +
                    (teeth.empty() ? "nor is any other; give its number in teeth.nrrd"
                                   : "these are: " + listOf(teeth) + "; name one with --tooth"));
  }
  std::optional<OperativeSite> site;
  for (const int fdi : {48, 38, 28, 18}) {
    if (std::ranges::find(teeth, fdi) == teeth.end()) continue;
    if (!site)
      site = siteAtTooth(ct, fdi);
    else
      remarks.push_back("tooth " + std::to_string(fdi) + " is labelled too; --tooth " + std::to_string(fdi) +
                        " makes it the site");
  }
  if (site) return site;
  remarks.push_back(
      "no third molar labelled here" +
      (teeth.empty() ? std::string() : "; these teeth are: " + listOf(teeth) + ", --tooth makes one of them the site"));
  return std::nullopt;
}

}  // namespace

ImportedScan importScan(const std::string& source, const ScanImportOptions& choices) {
  const Sources sources = sourcesAt(source);
  HounsfieldImage image = readHounsfield(sources.ct, choices.window);
  ImportedScan imported;
  Patient& patient = imported.patient;
  patient.classification = choices.classification;
  patient.ct.grid = image.grid;
  patient.ct.hounsfield = std::move(image.hounsfield);
  if (!choices.window) imported.remarks = scaleRemarks(patient.ct.grid, patient.ct.hounsfield);
  if (!image.orientation_known)
    imported.remarks.push_back("it does not say which side is right; taken as LPS (left-posterior-superior)");
  patient.ct.solid = classify(patient.ct.grid, patient.ct.hounsfield, choices.classification);
  const glm::dvec3 middle_P_mm = middleOfSolid(patient.ct, sources.ct, choices.classification.iso_hu);

  const Tissues tissues = readTissues(sources.labels, sources.ct, patient.ct, imported.remarks);
  if (sources.teeth)
    readTeeth(*sources.teeth, sources.ct, patient.ct, imported.remarks);
  else if (tissues == Tissues::labelled)
    takeMarkedTooth(choices.tooth_fdi, patient.ct, imported.remarks);
  if (tissues == Tissues::labelled) labelPartialVoxels(patient.ct);
  patient.site = siteOf(patient.ct, choices.tooth_fdi, source, imported.remarks);
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
  imported.remarks.push_back(jaw_P_mm ? "the view goes to the lower jaw"
                                      : "no lower jaw found, the view goes to the middle of what is solid");
  patient.jaw_P_mm = jaw_P_mm.value_or(middle_P_mm);
  patient.title = "imported scan, site unknown";
  return imported;
}

}  // namespace assets
