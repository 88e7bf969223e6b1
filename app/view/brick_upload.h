// Copies bricks that the servo has carved to the renderer: the one place where haptics meets render. Render thread,
// once a frame, before drawing. The bricks of a piece of tooth go with the jaw's where the frame shows it at rest, and
// to the piece's own mesh always, so that it leaves the jaw in the frame in which it appears beside it. Cost: a
// 512-byte copy and a small upload per dirty brick; all bricks of a piece when it leaves rest or comes back.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <set>
#include <span>
#include <tuple>
#include <vector>

#include <glm/glm.hpp>

#include "render/frame.h"

namespace haptics {
class Bodies;
}
namespace render {
class FrameRenderer;
}

namespace app {

class BrickUploader {
 public:
  /// The bricks that have changed since the last call, also those uploaded meanwhile; the others are uploaded later.
  std::vector<glm::ivec3> takeChanged(haptics::Bodies& from);
  /// Bricks of the jaw's grid that someone else has found changed, for the next upload.
  void tell(std::span<const glm::ivec3> changed) { waiting_.insert(changed.begin(), changed.end()); }
  /// Bricks changed since the last call, and those of pieces that have left rest or come back. `pieces`: of the frame
  /// to draw. Returns their number.
  std::size_t upload(haptics::Bodies& from, const render::MovedPieces& pieces, render::FrameRenderer& to);
  /// All bricks ever uploaded, and the pieces, to a new renderer of the initial bone.
  void uploadAllAgain(const haptics::Bodies& from, render::FrameRenderer& to);
  /// Every brick, and the pieces, to a new renderer of any bone with the tooth in it. Some tenths of a second.
  void uploadEverything(const haptics::Bodies& from, const render::MovedPieces& pieces, render::FrameRenderer& to);

 private:
  struct InOrder {
    bool operator()(const glm::ivec3& a, const glm::ivec3& b) const {
      return std::tie(a.z, a.y, a.x) < std::tie(b.z, b.y, b.x);
    }
  };
  /// A piece as the renderer shows it.
  struct Shown {
    bool has_mesh = false;  ///< it has held solid
    bool at_rest = true;
  };
  std::vector<glm::ivec3> followPieces(const haptics::Bodies& from, const render::MovedPieces& pieces,
                                       render::FrameRenderer& to);
  void uploadBrick(const haptics::Bodies& from, glm::ivec3 brick, render::FrameRenderer& to);

  void collect(haptics::Bodies& from);

  std::vector<glm::ivec3> changed_;  ///< since takeChanged()
  std::set<glm::ivec3, InOrder> waiting_, ever_;
  std::array<Shown, render::kMostPieces> pieces_;
};

}  // namespace app
