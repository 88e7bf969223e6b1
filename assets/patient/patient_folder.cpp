#include "assets/patient/patient_folder.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <utility>

#include "assets/load_error.h"
#include "assets/mesh/gltf_file.h"
#include "assets/patient/patient_toml.h"
#include "assets/patient/scan_origin_toml.h"
#include "assets/patient/statement_file.h"
#include "assets/scan/vdb_file.h"
#include "assets/scenery/face_frame.h"
#include "assets/toml_reader.h"
#include "calibration/output_file.h"

namespace assets {

namespace {

namespace fs = std::filesystem;

constexpr const char* kToml = "patient.toml";
constexpr const char* kVolume = "volume.vdb";
constexpr const char* kMeshes = "face.glb";
constexpr const char* kStatement = "deidentified.toml";
constexpr const char* kClicks = "clicks.json";
constexpr const char* kCheckPicture = "check.png";
constexpr const char* kScanTable = "\n[scan]\n";
constexpr const char* kGingivaPrefix = "Gum";
constexpr std::size_t kMaxToml_bytes = 4 << 20;

/// One model of both; the names of gingiva parts begin with the prefix, those of face parts do not.
MeshModel joined(const MeshModel& gingiva, const MeshModel& face) {
  MeshModel both = gingiva;
  for (MeshPart& part : both.parts)
    if (!part.name.starts_with(kGingivaPrefix)) part.name = std::string(kGingivaPrefix) + " " + part.name;
  for (const MeshPart& part : face.parts) {
    both.parts.push_back(part);
    if (part.name.starts_with(kGingivaPrefix)) both.parts.back().name = "Face " + part.name;
  }
  return both;
}

void separate(MeshModel both, MeshModel& gingiva, MeshModel& face) {
  for (MeshPart& part : both.parts)
    (part.name.starts_with(kGingivaPrefix) ? gingiva : face).parts.push_back(std::move(part));
}

bool isInside(const glm::dvec3& p_P_mm, const VolumeGrid& grid) {
  const glm::dvec3 index = grid.indexFromPoint(p_P_mm);
  return glm::all(glm::greaterThanEqual(index, glm::dvec3(-0.5))) &&
         glm::all(glm::lessThanEqual(index, glm::dvec3(grid.size) - 0.5));
}

}  // namespace

namespace {

/// What a folder tells of its scan beside the patient, as text; empty: nothing.
struct ScanWords {
  std::string table;
  /// deidentified.toml for a volume of that digest, signed.
  std::function<std::string(const std::string& volume_sha256)> statement;
};

void write(const Patient& patient, const std::string& folder, bool overwrite, const ScanWords& scan,
           const std::string& clicks, const FolderWatch& watch) {
  calibration::OutputFolder output(folder, overwrite, {kToml, kVolume, kMeshes, kStatement, kClicks, kCheckPicture});
  const fs::path written = output.temporaryPath();
  if (watch.begun) watch.begun(output.temporaryPath());
  calibration::OutputFile(written / kToml, false).commit(patientToml(patient) + scan.table);
  if (!clicks.empty()) calibration::OutputFile(written / kClicks, false).commit(clicks);
  writeVdb(patient.ct, (written / kVolume).string());
  const MeshModel meshes_P = joined(patient.gingiva, patient.face);
  if (!meshes_P.parts.empty()) writeGltf(modelInFaceFrame(meshes_P), (written / kMeshes).string());
  if (scan.statement)
    calibration::OutputFile(written / kStatement, false)
        .commit(scan.statement(digestOfFile((written / kVolume).string())));
  // So that what follows takes no time.
  for (const auto& entry : fs::directory_iterator(written)) calibration::syncToDisk(entry.path().string());
  if (watch.before_commit) watch.before_commit();
  output.commit();
}

}  // namespace

void savePatient(const Patient& patient, const std::string& folder, bool overwrite, const ScanOrigin* origin,
                 const std::string& clicks, const FolderWatch& watch) {
  ScanWords scan;
  if (origin != nullptr) {
    scan.table = scanTable(*origin);
    scan.statement = [origin](const std::string& digest) {
      return sealedStatement(deidentificationStatement(*origin, digest));
    };
  }
  write(patient, folder, overwrite, scan, clicks, watch);
}

StatementAfterEdits savePatientAgain(const Patient& patient, const std::string& folder, const std::string& clicks) {
  const fs::path path = folder;
  ScanWords scan;
  StatementAfterEdits became = StatementAfterEdits::none;
  const std::string toml = readSmallFile((path / kToml).string(), kMaxToml_bytes);
  if (const auto at = toml.find(kScanTable); at != std::string::npos) scan.table = toml.substr(at);
  if (const auto facts = statementIn(folder)) {
    const bool is_whole = isWhole(*facts);
    became = !is_whole            ? StatementAfterEdits::left_unsigned
             : facts->is_reviewed ? StatementAfterEdits::review_lapsed
                                  : StatementAfterEdits::renewed;
    scan.statement = [is_whole, text = readSmallFile((path / kStatement).string())](const std::string& digest) {
      return is_whole ? statementAfterEdits(text, digest) : text;
    };
  }
  write(patient, folder, true, scan, clicks, {});
  return became;
}

std::string clicksPath(const std::string& folder) { return (fs::path(folder) / kClicks).string(); }

std::string checkPicturePath(const std::string& folder) { return (fs::path(folder) / kCheckPicture).string(); }

Patient describedPatient(const std::string& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error))
    throw LoadError(folder + ": there is no such patient folder; make one with molar import");
  const std::string toml = (fs::path(folder) / kToml).string();
  return patientFromToml(readSmallFile(toml, kMaxToml_bytes, "make the patient with molar import"), toml);
}

namespace {

constexpr double kMeshesShare = 0.45;  // of the time that loading takes, on two cores

/// `volume()`: that of the folder, taken after the meshes were read.
template <class Volume>
Patient patientIn(const std::string& folder, Patient patient, const ReportProgress& report, const Volume& volume) {
  std::error_code error;
  const fs::path path = folder;
  const std::string toml = (path / kToml).string(), meshes = (path / kMeshes).string();
  if (fs::exists(meshes, error)) separate(modelInPatientFrame(readGltf(meshes)), patient.gingiva, patient.face);
  if (report) report(kMeshesShare);
  patient.ct = volume();
  if (report) report(1.0);
  if (patient.site && !isInside(patient.site->centre_P_mm, patient.ct.grid))
    throw LoadError(toml + ": the site lies outside the volume; import the scan again");
  // Folders older than tooth numbers: only the tooth at the site has enamel, dentine and pulp.
  if (patient.ct.tooth.empty() && patient.site) numberSingleTooth(patient.ct, patient.site->fdi);
  return patient;
}

}  // namespace

Patient loadPatient(const std::string& folder, const ReportProgress& report) {
  Patient described = describedPatient(folder);
  const auto reading = beginVdb((fs::path(folder) / kVolume).string());
  if (report) report(0.0);
  return patientIn(folder, std::move(described), report, [&] { return reading->take(); });
}

Patient loadPatient(const std::string& folder, const std::function<CtVolume()>& volume) {
  return patientIn(folder, describedPatient(folder), {}, volume);
}

}  // namespace assets
