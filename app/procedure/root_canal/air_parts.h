// Air of a box of voxels by what it is connected to: the outside, or enclosed; and voids beside what was laid. Solid
// from half a voxel on. Frame P, mm. Pure; any thread but the servo's; some 20 ns a voxel.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "assets/segment/cell_masks.h"
#include "assets/volume_grid.h"

namespace app {

/// 0 solid, 1 the outside, from 2 on the enclosed ones.
class AirParts {
 public:
  /// `solid` in the order of `grid`. All air at the box's faces is outside.
  AirParts(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid);

  bool isOutside(glm::ivec3 ijk) const { return !grid_.contains(ijk) || at(grid_.index(ijk)) == 1; }
  std::uint32_t at(std::size_t v) const { return number_[static_cast<std::size_t>(pieces_.of[v])]; }
  std::uint32_t count() const { return count_; }

 private:
  assets::VolumeGrid grid_;
  assets::CellPieces pieces_;
  std::vector<std::uint32_t> number_;  ///< by piece
  std::uint32_t count_ = 2;
};

/// Smaller ones are not told one by one.
inline constexpr double kLeastVoid_mm3 = 0.1;

struct EnclosedAir {
  double volume_mm3 = 0.0;
  glm::dvec3 middle_P_mm{0.0};
};

/// Parts that border on what was laid, of at least that size, the largest first, with the air in voxels at their rims.
/// `solid`: tooth and filling; `laid`: of it.
std::vector<EnclosedAir> voidsBeside(const AirParts& air, const assets::VolumeGrid& grid,
                                     std::span<const std::uint8_t> solid, std::span<const std::uint8_t> laid,
                                     double least_mm3);

}  // namespace app
