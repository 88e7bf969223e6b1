#include "app/view/brick_upload.h"

#include <algorithm>
#include <utility>

#include "haptics/body/bodies.h"
#include "render/frame_renderer.h"

namespace app {
namespace {

using Brick = std::array<std::uint8_t, 512>;

/// Also of those that hold nothing yet: solid may go over to them at any tick.
std::size_t placesForPieces(const haptics::Bodies& of) { return std::min(of.bones().size() - 1, render::kMostPieces); }

void setPiece(const haptics::Bodies& from, std::size_t piece, render::FrameRenderer& to) {
  const haptics::CarvedBone& bone = from.bones()[piece + 1];
  to.setPiece(piece, bone.grid(), bone.copyBox(glm::ivec3(0), bone.grid().size));
}

}  // namespace

void BrickUploader::uploadBrick(const haptics::Bodies& from, glm::ivec3 brick, render::FrameRenderer& to) {
  Brick solid{};
  from.jaw().copyBrick(brick, solid);
  const auto own = from.brickOfPiece(brick);
  for (std::size_t n = 0; own && n < placesForPieces(from); ++n) {
    Brick part{};
    from.bones()[n + 1].copyBrick(*own, part);
    // A piece that nothing was in yet gets its mesh with its first solid.
    if (pieces_[n].has_mesh)
      to.updatePieceBrick(n, *own, part);
    else if (part != Brick{})
      setPiece(from, n, to), pieces_[n].has_mesh = true;
    if (!pieces_[n].at_rest) continue;
    for (std::size_t v = 0; v < part.size(); ++v)
      solid[v] = static_cast<std::uint8_t>(std::min(255, solid[v] + part[v]));
  }
  if (const haptics::Filling* const filling = from.filling()) {
    haptics::FillingBrick one = filling->copyBrick(brick);
    for (std::size_t v = 0; v < solid.size(); ++v) {
      if (one.laid[v] < solid[v]) one.tissue[v] = 0;  // the larger part gives the colour
      solid[v] = static_cast<std::uint8_t>(std::min(255, solid[v] + one.laid[v]));
    }
    to.updateTissue(brick, one.tissue);
  }
  to.updateBrick(brick, solid);
}

/// The tooth for the first time, and pieces that have left rest or come back. Returns the bricks of the last two.
std::vector<glm::ivec3> BrickUploader::followPieces(const haptics::Bodies& from, const render::MovedPieces& pieces,
                                                    render::FrameRenderer& to) {
  std::vector<glm::ivec3> changed;
  for (std::size_t n = 0; n < placesForPieces(from); ++n) {
    Shown& shown = pieces_[n];
    const haptics::CarvedBone& bone = from.bones()[n + 1];
    if (n == 0 && !std::exchange(shown.has_mesh, true)) setPiece(from, n, to);
    const bool at_rest = !pieces[n].has_value();
    if (std::exchange(shown.at_rest, at_rest) == at_rest) continue;
    const glm::ivec3 first = from.firstBrick();
    assets::forVoxels(first, first + bone.grid().bricks(), [&](glm::ivec3 brick) { changed.push_back(brick); });
  }
  return changed;
}

void BrickUploader::collect(haptics::Bodies& from) {
  const auto before = static_cast<std::ptrdiff_t>(changed_.size());
  from.takeDirtyBricks(changed_);
  waiting_.insert(changed_.begin() + before, changed_.end());
  ever_.insert(changed_.begin() + before, changed_.end());
}

std::vector<glm::ivec3> BrickUploader::takeChanged(haptics::Bodies& from) {
  collect(from);
  return std::exchange(changed_, {});
}

std::size_t BrickUploader::upload(haptics::Bodies& from, const render::MovedPieces& pieces, render::FrameRenderer& to) {
  collect(from);
  const std::vector<glm::ivec3> of_pieces = followPieces(from, pieces, to);
  const auto bring = [&](glm::ivec3 brick) {
    uploadBrick(from, brick, to);
    ever_.insert(brick);
  };
  const std::size_t count = waiting_.size() + of_pieces.size();
  std::ranges::for_each(waiting_, bring);
  std::ranges::for_each(of_pieces, bring);
  waiting_.clear();
  return count;
}

void BrickUploader::uploadEverything(const haptics::Bodies& from, const render::MovedPieces& pieces,
                                     render::FrameRenderer& to) {
  followPieces(from, pieces, to);
  assets::forVoxels(glm::ivec3(0), from.grid().bricks(), [&](glm::ivec3 brick) { uploadBrick(from, brick, to); });
}

void BrickUploader::uploadAllAgain(const haptics::Bodies& from, render::FrameRenderer& to) {
  for (std::size_t n = 0; n < placesForPieces(from); ++n)
    if (pieces_[n].has_mesh) setPiece(from, n, to);
  for (const glm::ivec3 brick : ever_) uploadBrick(from, brick, to);
}

}  // namespace app
