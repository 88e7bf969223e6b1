#include "app/case/patient_source.h"

#include <atomic>
#include <filesystem>
#include <future>
#include <stdexcept>
#include <utility>

#include <fmt/core.h>

#include "app/case/cache_folder.h"
#include "app/case/gutter_plan.h"
#include "app/text/message.h"
#include "assets/load_error.h"
#include "assets/mesh/gltf_file.h"
#include "assets/patient/patient_folder.h"
#include "assets/patient/plain_volume.h"
#include "assets/scenery/face_placement.h"
#include "assets/scenery/gingiva_surface.h"
#include "assets/synthetic/face.h"

namespace app {
namespace {

namespace fs = std::filesystem;

std::string cacheName(const assets::JawParameters& p) {
  return fmt::format("built-in-{}-{}-{:g}-{:g}-{:g}-{:g}-{}-{:g}", assets::kSyntheticPatientRevision,
                     p.right_side ? "right" : "left", p.winter_angle_deg, p.depth_mm, p.mandibular_canal_distance_mm,
                     p.spacing_mm, p.seed, p.opening_mm);
}

/// Jaw and face are independent, and each has steps on one core, so they are made side by side. The shares are of
/// processor time.
assets::Patient generate(const assets::JawParameters& parameters, const assets::ReportProgress& report) {
  constexpr double kJawShare = 0.4, kFaceShare = 0.5;
  std::atomic<double> jaw{0.0}, face{0.0};
  const auto tell = [&] {
    if (report) report(kJawShare * jaw + kFaceShare * face);
  };
  std::future<assets::MeshModel> face_P = std::async(std::launch::async, [&] {
    return assets::syntheticFace({.tooth_fdi = parameters.right_side ? 48 : 38, .opening_mm = parameters.opening_mm},
                                 [&](double share) { face = share, tell(); });
  });
  assets::Patient patient = assets::syntheticJaw(parameters, [&](double share) { jaw = share, tell(); });
  patient.gingiva = assets::gingivaSurface(patient.ct, planGutter(patient, kUsualBurRadius_mm));
  patient.face = face_P.get();
  return patient;
}

/// Beside the patient's folder, which holds its own files only.
std::string keptVolumeFile(const fs::path& folder) { return folder.string() + ".volume"; }

/// Without it the next start takes a second longer.
void keepVolume(const assets::CtVolume& volume, const fs::path& folder) {
  try {
    assets::writePlainVolume(volume, keptVolumeFile(folder));
  } catch (const std::runtime_error&) {
  }
}

/// Volume and meshes side by side.
assets::Patient cachedPatient(const fs::path& folder, const assets::ReportProgress& report) {
  const std::string kept = keptVolumeFile(folder);
  std::error_code ignored;
  if (fs::exists(kept, ignored)) {
    if (report) report(0.0);
    std::future<assets::CtVolume> volume =
        std::async(std::launch::async, [&] { return assets::readPlainVolume(kept); });
    try {
      return assets::loadPatient(folder.string(), [&] { return volume.get(); });
    } catch (const assets::LoadError&) {
      fs::remove(kept, ignored);
    }
  }
  assets::Patient patient = assets::loadPatient(folder.string(), report);
  keepVolume(patient.ct, folder);
  return patient;
}

}  // namespace

assets::Patient builtInPatient(const assets::JawParameters& parameters, const assets::ReportProgress& report) {
  const fs::path folder = cacheFolder() / cacheName(parameters);
  std::error_code ignored;
  if (fs::exists(folder, ignored)) {
    try {
      return cachedPatient(folder, report);
    } catch (const assets::LoadError&) {
      printMessage("the cached built-in patient cannot be read, generating it again");
    }
  } else {
    printMessage("generating the built-in patient (once, up to a minute)");
    if (report) report(0.0);
  }
  assets::Patient made = generate(parameters, report);
  if (report) report(0.92);
  try {
    fs::create_directories(folder.parent_path(), ignored);
    assets::savePatient(made, folder.string(), true);
  } catch (const assets::LoadError& error) {
    printMessage(fmt::format("the built-in patient is not cached: {}", error.what()));
    return made;
  }
  keepVolume(made.ct, folder);
  // Read back from the cache, so that the first run equals the next.
  return assets::loadPatient(folder.string(), [&] { return std::move(made.ct); });
}

assets::FacePose replaceFace(assets::Patient& patient, const std::string& face_path) {
  const assets::MeshModel face_F = assets::readGltf(face_path);
  const fs::path teeth = fs::path(face_path).parent_path() / "teeth.json";
  const assets::FacePlacement placed = assets::fitFace(patient.ct, patient.site, assets::readFaceTeeth(teeth.string()));
  patient.face = assets::modelInPatientFrame(face_F, placed.X_PF);
  printMessage(fmt::format("face placed on {} teeth, {:.1f} mm rms, 1:1", placed.teeth, placed.rms_mm));
  return placed.X_PF;
}

}  // namespace app
