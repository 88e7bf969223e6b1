#include "assets/patient/patient_folder.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "assets/load_error.h"
#include "assets/mesh/gltf_file.h"
#include "assets/patient/patient_toml.h"
#include "assets/scan/vdb_file.h"
#include "assets/scenery/face_frame.h"
#include "calibration/output_file.h"

namespace assets {

namespace {

namespace fs = std::filesystem;

constexpr const char* kWords = "patient.toml";
constexpr const char* kVolume = "volume.vdb";
constexpr const char* kMeshes = "face.glb";
constexpr const char* kGingivaPrefix = "Gum";
constexpr std::uintmax_t kLongestWords = 4 << 20;

std::string readText(const std::string& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error))
    throw LoadError(path + ": there is no such file, so the folder is no patient; make one with molar import");
  if (fs::file_size(path, error) > kLongestWords)
    throw LoadError(path + ": it is too long for a patient; import the scan again");
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf())) throw LoadError(path + ": it can not be read; check its permissions");
  return text.str();
}

/// Gum and face as one model; their names tell them apart.
MeshModel joined(const MeshModel& gingiva, const MeshModel& face) {
  MeshModel both;
  for (const MeshPart& part : gingiva.parts) {
    both.parts.push_back(part);
    if (!part.name.starts_with(kGingivaPrefix)) both.parts.back().name = std::string(kGingivaPrefix) + " " + part.name;
  }
  for (const MeshPart& part : face.parts) {
    both.parts.push_back(part);
    if (part.name.starts_with(kGingivaPrefix)) both.parts.back().name = "Face " + part.name;
  }
  return both;
}

void divide(MeshModel both, MeshModel& gingiva, MeshModel& face) {
  for (MeshPart& one : both.parts)
    (one.name.starts_with(kGingivaPrefix) ? gingiva : face).parts.push_back(std::move(one));
}

bool isInside(const glm::dvec3& p_P_mm, const VolumeGrid& grid) {
  const glm::dvec3 index = grid.indexFromPoint(p_P_mm);
  return glm::all(glm::greaterThanEqual(index, glm::dvec3(-0.5))) &&
         glm::all(glm::lessThanEqual(index, glm::dvec3(grid.size) - 0.5));
}

/// A folder of before teeth were told apart: only the tooth at the site had enamel, dentine and pulp.
void tellSiteToothApart(CtVolume& ct, int fdi) {
  ct.tooth.resize(ct.label.size());
  std::ranges::transform(ct.label, ct.tooth.begin(), [fdi](std::uint8_t label) {
    const bool of_site =
        label >= static_cast<std::uint8_t>(Tissue::enamel) && label <= static_cast<std::uint8_t>(Tissue::pulp);
    return static_cast<std::uint8_t>(of_site ? fdi : 0);
  });
}

}  // namespace

void savePatient(const Patient& patient, const std::string& folder, bool overwrite) {
  calibration::OutputFolder output(folder, overwrite, {kWords, kVolume, kMeshes});
  const fs::path made = output.temporaryPath();
  calibration::OutputFile(made / kWords, false).commit(patientToml(patient));
  writeVdb(patient.ct, (made / kVolume).string());
  const MeshModel meshes_P = joined(patient.gingiva, patient.face);
  if (!meshes_P.parts.empty()) writeGltf(modelInFaceFrame(meshes_P), (made / kMeshes).string());
  output.commit();
}

Patient loadPatient(const std::string& folder) {
  std::error_code error;
  const fs::path path = folder;
  if (!fs::is_directory(path, error))
    throw LoadError(folder + ": there is no such patient folder; make one with molar import");

  const std::string words = (path / kWords).string();
  Patient patient = patientFromToml(readText(words), words);
  patient.ct = readVdb((path / kVolume).string());
  if (patient.site && !isInside(patient.site->centre_P_mm, patient.ct.grid))
    throw LoadError(words + ": the site lies outside the volume; import the scan again");
  if (patient.ct.tooth.empty() && patient.site) tellSiteToothApart(patient.ct, patient.site->fdi);

  const std::string meshes = (path / kMeshes).string();
  if (fs::exists(meshes, error)) divide(modelInPatientFrame(readGltf(meshes)), patient.gingiva, patient.face);
  return patient;
}

}  // namespace assets
