#include "app/procedure/preparation/removed_material.h"

#include "assets/ct_volume.h"
#include "assets/tissue.h"

namespace app {
namespace {

constexpr std::array<glm::ivec3, 6> kBeside{glm::ivec3{1, 0, 0}, {-1, 0, 0}, {0, 1, 0},
                                            {0, -1, 0},          {0, 0, 1},  {0, 0, -1}};

bool isPulp(std::uint8_t label) { return assets::Tissue{label} == assets::Tissue::pulp; }

}  // namespace

double RemovedMaterial::over_mm3() const {
  double sum = 0.0;
  for (const ZoneBalance& zone : zones) sum += zone.over_mm3;
  return sum;
}

double RemovedMaterial::under_mm3() const {
  double sum = 0.0;
  for (const ZoneBalance& zone : zones) sum += zone.under_mm3;
  return sum;
}

RemovedMaterial removedMaterial(const Crown& crown, const BoxBytes& made, const BoxBytes& ideal,
                                const ZoneOf& zone_of) {
  RemovedMaterial removed;
  const assets::VolumeGrid& grid = made.grid();
  const double voxel_mm3 = grid.voxelVolume_mm3(), face_mm2 = grid.spacing_mm * grid.spacing_mm;
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    const int had = crown.solid.bytes()[v], has = made.bytes()[v], wanted = ideal.bytes()[v];
    if (had == has && had == wanted) return;
    const std::uint8_t label = crown.label.bytes()[v];
    const double cut_mm3 = (had - has) / 255.0 * voxel_mm3;
    if (label == static_cast<std::uint8_t>(assets::Tissue::other_teeth)) {
      removed.neighbour_mm3 += cut_mm3;
      return;
    }
    if (isPulp(label)) return;
    removed.wanted_mm3 += (had - wanted) / 255.0 * voxel_mm3;
    if (assets::Tissue{label} == assets::Tissue::enamel) removed.enamel_mm3 += cut_mm3;
    if (assets::Tissue{label} == assets::Tissue::dentine) removed.dentine_mm3 += cut_mm3;
    // Firm caries may stay or go.
    if (has != wanted && assets::Tissue{label} != assets::Tissue::caries_firm) {
      auto& zone = removed.zones[static_cast<std::size_t>(zone_of(crown.frame.local(grid.centre_P_mm(ijk))))];
      (has < wanted ? zone.over_mm3 : zone.under_mm3) += std::abs(wanted - has) / 255.0 * voxel_mm3;
    }
    // Where tooth is gone beside the pulp.
    if (had >= assets::kHalfSolid && has < assets::kHalfSolid)
      for (const glm::ivec3& way : kBeside)
        if (isPulp(crown.label.voxel(ijk + way))) removed.pulp_open_mm2 += face_mm2;
  });
  return removed;
}

}  // namespace app
