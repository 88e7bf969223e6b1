// Teeth in three dimensions inside a ghost of the bone: parallel rays through what voxels belong to (jaw_views.h), each
// to the first tooth, with a veil of the bone before it. Frame P, mm. Pure but for parallel rows (TBB); any thread.
// Cost: 0.2 us of CPU a pixel.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "app/check_page/jaw_views.h"
#include "app/check_page/label_bricks.h"
#include "render/image.h"

namespace app {

class SolidPicture {
 public:
  /// Both outlive it; `what` of every voxel.
  SolidPicture(const assets::VolumeGrid& grid, const std::vector<std::uint8_t>& what, const LabelBricks& bricks)
      : grid_(grid), what_(what), bricks_(bricks) {}

  void draw(const JawViews::Plane& plane, const PixelBox& box, render::Image& image) const;
  /// The tooth that is seen there.
  std::optional<glm::dvec3> toothAt(const JawViews::Plane& plane, const glm::dvec2& at_px) const;

 private:
  struct Seen {
    std::uint8_t tooth = 0;
    glm::ivec3 voxel{0};
    bool is_through_bone = false;
    glm::ivec3 bone{0};  ///< its first voxel
  };
  struct Rays;
  Seen along(const Rays& rays, const glm::dvec2& at_px, bool sees_bone) const;
  float facing(const glm::ivec3& voxel, std::uint8_t own, bool is_own_inside, const glm::vec3& direction) const;

  const assets::VolumeGrid& grid_;
  const std::vector<std::uint8_t>& what_;
  const LabelBricks& bricks_;
};

}  // namespace app
