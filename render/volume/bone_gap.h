// The gap between a bur and tooth and bone as they are drawn: the shortest way from the surface solid = 0.5 to the
// cutting head, any form. Frame P, mm. The surface is taken where it crosses the edges of the voxel lattice, around the
// nearest places on a lattice four times finer, so that the error is below a quarter of a voxel. Bricks are visited
// from near to far; which of them have surface is remembered until they change. Render thread. Cost: 20 to 200 us a
// pose. Distances to the head: volume/bur_distance.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "assets/volume_grid.h"
#include "render/frame.h"
#include "render/volume/bordered_field.h"

namespace render {

class GapFinder {
 public:
  /// Borrows the solid fraction, 255 for solid.
  GapFinder(const assets::VolumeGrid& grid, const BorderedField<std::uint8_t>& solid);

  /// The values of this brick changed.
  void touch(glm::ivec3 brick);
  /// Of the bur of `frame`, whose `gap` is not read. None farther than kMaxGap_mm; 0 mm in contact and inside.
  std::optional<BoneGap> find(const Frame& frame);

 private:
  enum class Mark : std::uint8_t { unknown, no_surface, surface };
  struct Nearby {
    float at_least_mm;
    glm::ivec3 brick;
  };
  bool hasSurface(glm::ivec3 brick);
  void collect(const glm::dvec3& centre_P_mm, double reach_mm, double enclosing_mm);

  assets::VolumeGrid grid_;
  const BorderedField<std::uint8_t>& solid_;
  glm::ivec3 bricks_;
  std::vector<Mark> marks_;
  std::vector<Nearby> nearby_;
};

}  // namespace render
