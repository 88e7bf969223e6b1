// What is painted on the live tooth of a preparation (render/volume/surface_paint.h): places of its surface with a
// colour each, spread over the voxels around them, so that a ray that meets the surface reads the colour. The spots of
// a measure are made beside it, on its thread (20 ms for 50,000 places); laid together into one paint in some 5 ms,
// later ones over earlier ones. Frame P, mm. Pure; any thread.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "assets/volume_grid.h"
#include "render/volume/surface_paint.h"

namespace app {

struct PaintSpot {
  std::uint32_t voxel = 0;  ///< of the box, i fastest
  std::uint32_t texel = 0;  ///< render::paintTexel()
};
using PaintSpots = std::vector<PaintSpot>;

/// What is drawn on a tooth from the beginning.
struct DrawnOutline {
  assets::VolumeGrid box;  ///< of the spots
  PaintSpots spots;
};

/// Gathers places of one measure; where several are near, their mean.
class PaintBrush {
 public:
  explicit PaintBrush(const assets::VolumeGrid& box) : box_(box), at_(box.voxelCount(), -1) {}

  /// sRGB, 0..1.
  void lay(const glm::dvec3& p_P_mm, const glm::dvec3& srgb);
  /// Less than full near the rim of what was laid where `soft`: marks of paper, not measures.
  PaintSpots spots(float cover = 1.0F) const;

 private:
  struct Sum {
    glm::vec3 linear{0.0F};
    float weight = 0.0F;
    std::uint32_t voxel = 0;
  };
  assets::VolumeGrid box_;
  std::vector<std::int32_t> at_;  ///< of the sums; -1: none
  std::vector<Sum> sums_;
};

/// `box`: of which the spots are voxels; a part of the grid `volume`.
render::SurfacePaint paintOf(const assets::VolumeGrid& volume, const assets::VolumeGrid& box,
                             std::span<const PaintSpots* const> spots);

}  // namespace app
