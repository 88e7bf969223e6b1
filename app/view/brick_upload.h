// Where haptics and render meet: what the servo carved since the last frame goes to the picture.
// Render thread, once a frame, before drawing. Cost: a 512-byte copy and a small upload per dirty brick.
#pragma once

#include <cstddef>
#include <set>
#include <tuple>
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
  /// All that was ever brought, to a renderer that was made from the bone of the start.
  void uploadAllAgain(const haptics::CarvedBone& from, render::FrameRenderer& to) const;

 private:
  struct InOrder {
    bool operator()(const glm::ivec3& a, const glm::ivec3& b) const {
      return std::tie(a.z, a.y, a.x) < std::tie(b.z, b.y, b.x);
    }
  };

  std::vector<glm::ivec3> bricks_;
  std::set<glm::ivec3, InOrder> ever_;
};

}  // namespace app
