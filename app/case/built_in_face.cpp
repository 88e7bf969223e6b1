#include "app/case/built_in_face.h"

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "app/case/own_face.h"
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

/// Of the head with the built-in face's teeth, or why not.
struct Placed {
  std::optional<assets::FacePlacement> placement;
  std::string why_not;
};
Placed placedByTeeth(const assets::Patient& patient, const std::vector<assets::FaceTooth>& teeth) {
  if (!patient.site || assets::isUpper(patient.site->fdi)) return {{}, "no lower tooth is operated"};
  try {
    const assets::FacePlacement placed = assets::fitFace(patient.ct, patient.site, teeth);
    if (placed.rms_mm <= kMostMiss_mm) return {placed, {}};
    return {{}, fmt::format("its teeth miss those of the scan by {:.1f} mm", placed.rms_mm)};
  } catch (const assets::LoadError& error) {
    return {{}, error.what()};
  }
}

}  // namespace

std::string placeBuiltInFace(assets::Patient& patient) {
  const std::vector<assets::FaceTooth> teeth = assets::builtInFaceTeeth();
  const Placed placed = placedByTeeth(patient, teeth);
  if (!placed.placement) return placed.why_not;
  const assets::MeshModel face = assets::syntheticFace({.tooth_fdi = assets::isRight(patient.site->fdi) ? 48 : 38});
  patient.face = assets::modelInPatientFrame(assets::modelInFaceFrame(face), placed.placement->X_PF);
  assets::dropTeeth(patient.face, *placed.placement, teeth, lowerTeeth_P_mm(patient.ct));
  patient.has_built_in_face = true;
  patient.X_PF = placed.placement->X_PF;
  return {};
}

bool placeOwnFace(assets::Patient& patient) {
  const int fdi = patient.operatedTooth();
  const Placed placed = placedByTeeth(patient, assets::builtInFaceTeeth());
  if (placed.placement) patient.X_PF = placed.placement->X_PF;
  // The line of sight is told in the axes of an upright scan.
  const assets::FacePose X_PF = patient.X_PF.value_or(assets::kFaceAxes_PF);
  const glm::dvec3 to_eye_P =
      X_PF.rotation * (glm::conjugate(assets::kFaceAxes_PF.rotation) * assets::surgeonEyeDirection(fdi));
  assets::MeshModel face = ownFace(patient.ct, patient.focus_P_mm(), to_eye_P);
  if (face.parts.empty()) return false;
  patient.face = std::move(face);
  patient.has_built_in_face = false;
  return true;
}

}  // namespace app
