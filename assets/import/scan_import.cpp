#include "assets/import/scan_import.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <optional>

#include "assets/image_file.h"
#include "assets/import/canal_line.h"
#include "assets/import/third_molar.h"
#include "assets/import/tissue_from_grey.h"
#include "assets/load_error.h"
#include "assets/solid_fraction.h"

namespace assets {

namespace {

namespace fs = std::filesystem;

struct Sources {
  std::string ct;
  std::optional<std::string> labels;
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
    return {source, std::nullopt};
  }

  const auto ct = volumeNamed(source, "ct");
  if (ct) return {*ct, volumeNamed(source, "labels")};
  for (const auto& entry : fs::directory_iterator(source, error))
    if (entry.is_regular_file(error) && (entry.path().extension() == ".dcm" || isDicom(entry.path())))
      throw LoadError(source + ": " + dicom_advice);
  throw LoadError(source +
                  ": it holds no ct.nrrd (or .nii.gz, .nii, .mha); name the volume so, or give the file itself");
}

/// Middle of what is solid; refuses a scan without any.
glm::dvec3 middleOfSolid(const CtVolume& ct, const std::string& path, double iso_hu) {
  glm::dvec3 sum(0.0);
  double weight = 0.0;
  std::size_t v = 0;
  for (int k = 0; k < ct.grid.size.z; ++k)
    for (int j = 0; j < ct.grid.size.y; ++j)
      for (int i = 0; i < ct.grid.size.x; ++i, ++v) {
        sum += static_cast<double>(ct.solid[v]) * glm::dvec3(i, j, k);
        weight += ct.solid[v];
      }
  constexpr double kSolid = 255.0;
  if (weight * ct.grid.voxelVolume_mm3() < kSolid * 10.0)
    throw LoadError(path + ": less than 10 mm3 of it is above " + std::to_string(static_cast<int>(iso_hu)) +
                    " HU; give a CT in Hounsfield, or another --iso");
  return ct.grid.origin_P_mm + ct.grid.spacing_mm * sum / weight;
}

}  // namespace

Patient importScan(const std::string& source, const Classification& classification) {
  const Sources sources = sourcesAt(source);
  HounsfieldImage image = readHounsfield(sources.ct);
  Patient patient;
  patient.classification = classification;
  patient.ct.grid = image.grid;
  patient.ct.hounsfield = std::move(image.hounsfield);
  patient.ct.solid = classify(patient.ct.grid, patient.ct.hounsfield, classification);
  const glm::dvec3 middle_P_mm = middleOfSolid(patient.ct, sources.ct, classification.iso_hu);

  if (sources.labels) {
    ByteImage labels = readLabels(*sources.labels);
    if (!isSameGrid(labels.grid, patient.ct.grid))
      throw LoadError(*sources.labels + ": its voxels do not lie where those of " + sources.ct +
                      " do; export both on the same grid");
    patient.ct.label = std::move(labels.values);
    patient.site = thirdMolarSite(patient.ct.grid, patient.ct.label);
    const auto beside_P_mm = patient.site.known ? std::optional(patient.site.third_molar_P_mm) : std::nullopt;
    if (auto canal = canalLine(patient.ct.grid, patient.ct.label, beside_P_mm)) {
      patient.canal_P_mm = std::move(canal->line_P_mm);
      patient.canal_radius_mm = canal->radius_mm;
    }
  } else {
    patient.ct.label = labelsFromGrey(patient.ct.hounsfield);
  }

  if (!patient.site.known) patient.site.third_molar_P_mm = middle_P_mm;
  patient.title = patient.site.known ? "imported scan, third molar " + std::to_string(patient.site.tooth_fdi)
                                     : std::string("imported scan, site unknown");
  return patient;
}

}  // namespace assets
