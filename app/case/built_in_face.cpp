#include "app/case/built_in_face.h"

#include <map>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "assets/load_error.h"
#include "assets/synthetic/face.h"
#include "assets/synthetic/face_teeth.h"
#include "assets/tooth.h"

namespace app {
namespace {

/// Different people's arches differ by some millimetres.
constexpr double kMostMiss_mm = 5.0;

/// Middles of the lower teeth of the scan.
std::vector<glm::dvec3> lowerTeeth_P_mm(const assets::CtVolume& ct) {
  std::map<int, assets::VoxelSum> sums;
  if (!ct.tooth.empty())
    assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
      if (ct.tooth[v] == 0 || assets::isUpper(ct.tooth[v])) return;
      assets::VoxelSum& sum = sums[ct.tooth[v]];
      sum.count += 1.0, sum.sum += glm::dvec3(ijk);
    });
  std::vector<glm::dvec3> middles;
  for (const auto& [fdi, sum] : sums) middles.push_back(ct.grid.origin_P_mm + ct.grid.spacing_mm * sum.sum / sum.count);
  return middles;
}

}  // namespace

std::string placeBuiltInFace(assets::Patient& patient) {
  if (!patient.site || assets::isUpper(patient.site->fdi)) return "no lower tooth is operated";
  const std::vector<assets::FaceTooth> teeth = assets::builtInFaceTeeth();
  assets::FacePlacement placed;
  try {
    placed = assets::fitFace(patient.ct, patient.site, teeth);
  } catch (const assets::LoadError& error) {
    return error.what();
  }
  if (placed.rms_mm > kMostMiss_mm) return fmt::format("its teeth miss those of the scan by {:.1f} mm", placed.rms_mm);
  const assets::MeshModel face = assets::syntheticFace({.tooth_fdi = assets::isRight(patient.site->fdi) ? 48 : 38});
  patient.face = assets::modelInPatientFrame(assets::modelInFaceFrame(face), placed.X_PF);
  assets::dropTeeth(patient.face, placed, teeth, lowerTeeth_P_mm(patient.ct));
  patient.has_built_in_face = true;
  return {};
}

}  // namespace app
