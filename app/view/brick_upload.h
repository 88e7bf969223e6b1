// Copies bricks that the servo has carved to the renderer: the one place where haptics meets render. Render thread,
// once a frame, before drawing. Pieces at rest are drawn with the jaw. Cost: a 512-byte copy and a small upload per
// dirty brick.
#pragma once

#include <cstddef>
#include <set>
#include <tuple>
#include <vector>

#include <glm/glm.hpp>

namespace haptics {
class Bodies;
}
namespace render {
class FrameRenderer;
}

namespace app {

class BrickUploader {
 public:
  /// Bricks changed since the last call. Returns their number.
  std::size_t upload(haptics::Bodies& from, render::FrameRenderer& to);
  /// Of the last upload().
  const std::vector<glm::ivec3>& uploaded() const { return bricks_; }
  /// All bricks ever uploaded, to a new renderer of the initial bone.
  void uploadAllAgain(const haptics::Bodies& from, render::FrameRenderer& to) const;

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
