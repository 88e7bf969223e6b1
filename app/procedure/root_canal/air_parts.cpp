#include "app/procedure/root_canal/air_parts.h"

#include <algorithm>
#include <functional>

namespace app {
namespace {

constexpr int kHalfSolid = 128, kWholeSolid = 255;

}  // namespace

AirParts::AirParts(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid) : grid_(grid) {
  std::vector<std::uint8_t> air(grid_.voxelCount());
  std::ranges::transform(solid, air.begin(),
                         [](std::uint8_t byte) { return static_cast<std::uint8_t>(byte < kHalfSolid ? 1 : 0); });
  pieces_ = assets::piecesOfCells(grid_.size, air);
  number_.assign(pieces_.cells.size(), 0);
  assets::forVoxels(grid_, [&](glm::ivec3 ijk, std::size_t v) {
    const bool at_face = glm::any(glm::equal(ijk, glm::ivec3(0))) || glm::any(glm::equal(ijk, grid_.size - 1));
    if (at_face && air[v] != 0) number_[static_cast<std::size_t>(pieces_.of[v])] = 1;
  });
  for (std::size_t piece = 1; piece < number_.size(); ++piece)
    if (number_[piece] == 0) number_[piece] = count_++;
}

std::vector<EnclosedAir> voidsBeside(const AirParts& air, const assets::VolumeGrid& grid,
                                     std::span<const std::uint8_t> solid, std::span<const std::uint8_t> laid,
                                     double least_mm3) {
  struct Sum {
    double air = 0.0, voxels = 0.0;
    glm::dvec3 index{0.0};
    bool is_beside_filling = false;
  };
  std::vector<Sum> sums(air.count());
  assets::forVoxels(glm::ivec3(1), grid.size - 1, [&](glm::ivec3 ijk) {
    const std::size_t v = grid.index(ijk);
    std::uint32_t part = air.at(v);
    for (int axis = 0; axis < 3 && part == 0; ++axis)
      for (const int way : {-1, 1}) {
        glm::ivec3 next = ijk;
        next[axis] += way;
        part = std::max(part, air.at(grid.index(next)));
      }
    if (part < 2) return;
    Sum& sum = sums[part];
    sum.air += (kWholeSolid - solid[v]) / 255.0;
    sum.voxels += 1.0;
    sum.index += glm::dvec3(ijk);
    sum.is_beside_filling = sum.is_beside_filling || laid[v] != 0;
  });
  std::vector<EnclosedAir> voids;
  for (const Sum& sum : sums) {
    const double volume_mm3 = sum.air * grid.voxelVolume_mm3();
    if (!sum.is_beside_filling || volume_mm3 < least_mm3) continue;
    voids.push_back({volume_mm3, grid.origin_P_mm + grid.spacing_mm / sum.voxels * sum.index});
  }
  std::ranges::sort(voids, std::greater{}, &EnclosedAir::volume_mm3);
  return voids;
}

}  // namespace app
