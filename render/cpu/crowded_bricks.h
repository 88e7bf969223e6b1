// How far soft shade can be felt: per brick of 8x8x8 voxels the Chebyshev distance in bricks to the next brick whose
// samples of the ambient map are not all zero, 0 within one, at most kFarthest. Carving only empties bricks, so
// distances left as they are stay safe; a brick that fills up again makes them new. Render thread; about 1 ms for 256^3
// voxels.
#pragma once

#include <cstdint>
#include <vector>

#include "render/volume/volume_fields.h"

namespace render {

class CrowdedBricks {
 public:
  static constexpr std::uint8_t kFarthest = 31;

  explicit CrowdedBricks(const VolumeFields& fields);

  /// After the fields were prepared.
  void update(const VolumeFields& fields, const FieldChanges& changes);

  glm::ivec3 bricks() const { return bricks_; }
  /// i fastest.
  const std::uint8_t* distances() const { return distances_.data(); }

 private:
  std::size_t index(glm::ivec3 brick) const;
  bool isCrowded(const VolumeFields& fields, glm::ivec3 brick) const;
  void measure();

  glm::ivec3 bricks_;
  std::vector<std::uint8_t> is_crowded_, distances_;
};

}  // namespace render
