#include "app/session/measures/perforation.h"

#include <algorithm>
#include <array>
#include <functional>
#include <unordered_map>

#include "assets/ct_volume.h"
#include "assets/tissue.h"

namespace app {
namespace {

constexpr std::array<glm::ivec3, 6> kFaces{glm::ivec3{1, 0, 0}, {-1, 0, 0}, {0, 1, 0},
                                           {0, -1, 0},          {0, 0, 1},  {0, 0, -1}};
constexpr double kTowards = 0.577;  ///< cosine of a face that looks to the tongue

}  // namespace

bool RemovedBone::isGone(std::size_t v) const {
  return assets::isHard(label[v]) && !assets::isTooth(label[v]) && before[v] >= assets::kHalfSolid &&
         after[v] < assets::kHalfSolid;
}

std::vector<Hole> perforations(const RemovedBone& bone, const assets::StructureDistance& lingual,
                               const glm::dvec3& lingual_P) {
  const assets::VolumeGrid& grid = bone.clock.grid();
  struct Open {
    const RemovedVoxel* voxel;
    int faces = 0;
    bool is_taken = false;
  };
  std::vector<Open> open;
  std::unordered_map<std::size_t, std::size_t> at;  // by voxel, in `open`
  for (const RemovedVoxel& voxel : bone.clock.removed()) {
    if (!bone.isGone(voxel.index)) continue;
    int faces = 0;
    for (const glm::ivec3& way : kFaces)
      if (glm::dot(glm::dvec3(way), lingual_P) > kTowards && lingual.near_mm(grid.centre_P_mm(voxel.ijk + way)) < 0.0)
        ++faces;
    if (faces == 0) continue;
    at.emplace(voxel.index, open.size());
    open.push_back({&voxel, faces});
  }
  // What touches, corners included, is one hole.
  std::vector<Hole> holes;
  std::vector<std::size_t> part;
  for (std::size_t first = 0; first < open.size(); ++first) {
    if (open[first].is_taken) continue;
    open[first].is_taken = true;
    part.assign(1, first);
    Hole hole;
    int faces = 0;
    for (std::size_t n = 0; n < part.size(); ++n) {
      const RemovedVoxel& voxel = *open[part[n]].voxel;
      faces += open[part[n]].faces;
      hole.centre_P_mm += grid.centre_P_mm(voxel.ijk);
      if (voxel.t_s && (!hole.first_s || *voxel.t_s < *hole.first_s)) hole.first_s = voxel.t_s;
      assets::forVoxels(voxel.ijk - 1, voxel.ijk + 2, [&](glm::ivec3 beside) {
        if (!grid.contains(beside)) return;
        const auto found = at.find(grid.index(beside));
        if (found == at.end() || open[found->second].is_taken) return;
        open[found->second].is_taken = true;
        part.push_back(found->second);
      });
    }
    hole.area_mm2 = faces * grid.spacing_mm * grid.spacing_mm;
    hole.centre_P_mm /= static_cast<double>(part.size());
    if (hole.area_mm2 >= kLeastPerforation_mm2) holes.push_back(hole);
  }
  std::ranges::stable_sort(holes, std::greater{}, &Hole::area_mm2);
  return holes;
}

std::optional<double> wallLeft_mm(const RemovedBone& bone, const assets::StructureDistance& lingual) {
  const assets::VolumeGrid& grid = bone.clock.grid();
  std::optional<double> least_mm;
  for (const RemovedVoxel& voxel : bone.clock.removed()) {
    if (!bone.isGone(voxel.index)) continue;
    const glm::dvec3 p = grid.centre_P_mm(voxel.ijk);
    double mm = lingual.near_mm(p);
    if (mm >= assets::StructureDistance::kReach_mm) {
      if (least_mm && *least_mm <= mm) continue;
      mm = lingual.at_mm(p);
    }
    if (!least_mm || mm < *least_mm) least_mm = mm;
  }
  // A voxel at the surface leaves nothing before it.
  constexpr double kAtSurface_voxels = 1.0 - assets::StructureDistance::kSurface_voxels;
  return least_mm ? std::optional(std::max(0.0, *least_mm - (kAtSurface_voxels + 1e-3) * grid.spacing_mm))
                  : std::nullopt;
}

}  // namespace app
