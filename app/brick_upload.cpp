#include "app/brick_upload.h"

#include <array>

#include "haptics/bone/carved_bone.h"
#include "render/frame_renderer.h"

namespace app {

std::size_t BrickUpload::bring(haptics::CarvedBone& from, render::FrameRenderer& to) {
  bricks_.clear();
  from.dirtyBricks().takeInto(bricks_);
  std::array<std::uint8_t, 512> solid{};
  for (const glm::ivec3 brick : bricks_) {
    from.copyBrick(brick, solid);
    to.updateBrick(brick, solid);
  }
  return bricks_.size();
}

}  // namespace app
