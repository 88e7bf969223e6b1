// A patient folder of a jaw in closed form (tests/assets/segment/arch_phantom.h), as the program found it.
#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include <unistd.h>

#include "app/options/jaw_clicks_file.h"
#include "assets/import/found_jaw.h"
#include "assets/patient/patient_folder.h"
#include "assets/scan/solid_fraction.h"
#include "assets/segment/voxel_edits.h"
#include "tests/assets/segment/arch_phantom.h"

namespace tests {

inline assets::Patient phantomPatient(const ArchPhantom& phantom, const assets::JawClicks& clicks = {}) {
  assets::Patient patient;
  patient.title = assets::titleOf({});
  patient.ct.grid = phantom.grid;
  patient.ct.hounsfield = phantom.hounsfield;
  patient.ct.solid = assets::classify(phantom.grid, phantom.hounsfield, patient.classification);
  assets::JawSegmentation found = assets::segmentJaw(phantom.grid, assets::greyToSearch(patient.ct), {}, clicks);
  assets::applyVoxelEdits({patient.ct.grid, patient.ct.hounsfield}, clicks.voxels, found);
  assets::takeFoundJaw(std::move(found), patient);
  return patient;
}

/// Removed with it.
class PhantomFolder {
 public:
  explicit PhantomFolder(const std::string& name, const assets::Patient& patient)
      : folder_(std::filesystem::temp_directory_path() / (name + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
    assets::savePatient(patient, path(), true);
  }
  ~PhantomFolder() { std::filesystem::remove_all(folder_); }
  PhantomFolder(const PhantomFolder&) = delete;
  PhantomFolder& operator=(const PhantomFolder&) = delete;

  std::string path() const { return (folder_ / "patient").string(); }

 private:
  std::filesystem::path folder_;
};

inline glm::dvec3 centreOf(const ArchPhantom& phantom, int fdi) {
  const assets::VoxelSum sum =
      assets::voxelSum(phantom.grid, [&](std::size_t v) { return phantom.tooth[v] == static_cast<std::uint8_t>(fdi); });
  return phantom.grid.origin_P_mm + phantom.grid.spacing_mm * sum.sum / sum.count;
}

}  // namespace tests
