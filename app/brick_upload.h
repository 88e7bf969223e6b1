// Where haptics and render meet: what the servo carved since the last frame goes to the picture.
// Render thread, once a frame, before drawing. Cost: a 512-byte copy and a small upload per dirty brick.
#pragma once

#include <cstddef>
#include <vector>

#include <glm/glm.hpp>

namespace haptics {
class CarvedBone;
}
namespace render {
class FrameRenderer;
}

namespace app {

class BrickUpload {
 public:
  /// Returns how many bricks were brought over.
  std::size_t bring(haptics::CarvedBone& from, render::FrameRenderer& to);

 private:
  std::vector<glm::ivec3> bricks_;
};

}  // namespace app
