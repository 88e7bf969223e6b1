#include "app/view/brick_upload.h"

#include <array>

#include "haptics/bone/carved_bone.h"
#include "render/frame_renderer.h"

namespace app {

namespace {

void bringBrick(const haptics::CarvedBone& from, glm::ivec3 brick, render::FrameRenderer& to) {
  std::array<std::uint8_t, 512> solid{};
  from.copyBrick(brick, solid);
  to.updateBrick(brick, solid);
}

}  // namespace

std::size_t BrickUpload::bring(haptics::CarvedBone& from, render::FrameRenderer& to) {
  bricks_.clear();
  from.dirtyBricks().takeInto(bricks_);
  for (const glm::ivec3 brick : bricks_) {
    bringBrick(from, brick, to);
    ever_.insert(brick);
  }
  return bricks_.size();
}

void BrickUpload::uploadAllAgain(const haptics::CarvedBone& from, render::FrameRenderer& to) const {
  for (const glm::ivec3 brick : ever_) bringBrick(from, brick, to);
}

}  // namespace app
