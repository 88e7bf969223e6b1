#include "app/view/brick_upload.h"

#include <array>

#include "haptics/body/bodies.h"
#include "render/frame_renderer.h"

namespace app {

namespace {

void uploadBrick(const haptics::Bodies& from, glm::ivec3 brick, render::FrameRenderer& to) {
  std::array<std::uint8_t, 512> solid{};
  from.copyBrick(brick, solid);
  to.updateBrick(brick, solid);
}

}  // namespace

std::size_t BrickUploader::upload(haptics::Bodies& from, render::FrameRenderer& to) {
  bricks_.clear();
  from.takeDirtyBricks(bricks_);
  for (const glm::ivec3 brick : bricks_) {
    uploadBrick(from, brick, to);
    ever_.insert(brick);
  }
  return bricks_.size();
}

void BrickUploader::uploadAllAgain(const haptics::Bodies& from, render::FrameRenderer& to) const {
  for (const glm::ivec3 brick : ever_) uploadBrick(from, brick, to);
}

}  // namespace app
