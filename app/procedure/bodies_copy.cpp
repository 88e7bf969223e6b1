#include "app/procedure/bodies_copy.h"

#include <algorithm>

#include "assets/ct_volume.h"

namespace app {
namespace {

bool isHalfSolid(std::uint8_t solid) { return solid >= assets::kHalfSolid; }

/// Pieces that touch, as along a break, stay pieces: a voxel's gap between them.
void partBodies(const BodiesCopy& bodies, const assets::VolumeGrid& grid, std::vector<std::uint8_t>& solid) {
  const auto holder = [&](std::size_t v) {
    std::size_t most = 0;
    for (std::size_t n = 1; n < bodies.piece.size(); ++n) {
      const auto here = [&](std::size_t piece) { return bodies.piece[piece].empty() ? 0 : bodies.piece[piece][v]; };
      if (here(n) > here(most)) most = n;
    }
    return most;
  };
  std::vector<std::size_t> between;
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (!isHalfSolid(solid[v])) return;
    for (int axis = 0; axis < 3; ++axis) {
      glm::ivec3 next = ijk;
      if (++next[axis] >= grid.size[axis]) continue;
      const std::size_t beside = grid.index(next);
      if (isHalfSolid(solid[beside]) && holder(beside) != holder(v)) between.push_back(v);
    }
  });
  for (const std::size_t v : between) solid[v] = 0;
}

/// The nearest voxel counts.
std::vector<std::uint8_t> whereItLies(const assets::VolumeGrid& grid, const std::vector<std::uint8_t>& at_rest,
                                      const haptics::PiecePose& X_PQ) {
  std::vector<std::uint8_t> moved(at_rest.size(), 0);
  const auto X_QP = X_PQ.inverse();
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    const calibration::Point<calibration::Patient> p_P{grid.centre_P_mm(ijk)};
    const glm::ivec3 from(glm::round(grid.indexFromPoint((X_QP * p_P).mm)));
    if (grid.contains(from)) moved[v] = at_rest[grid.index(from)];
  });
  return moved;
}

}  // namespace

BodiesCopy copyOfPieces(const haptics::Bodies& bodies, const haptics::Tick& newest) {
  BodiesCopy copy;
  copy.X_PQ = newest.X_PQ;
  for (std::size_t n = 0; n < newest.pieces; ++n) {
    if (haptics::Bodies::isAside(newest.X_PQ[n])) {
      copy.is_any_out = true;
      continue;
    }
    const haptics::CarvedBone& piece = bodies.bones()[n + 1];
    copy.piece[n] = piece.copyBox(glm::ivec3(0), piece.grid().size);
  }
  return copy;
}

void layWhereTheyAre(BodiesCopy& bodies, const assets::VolumeGrid& grid) {
  for (std::size_t n = 0; n < bodies.piece.size(); ++n)
    if (!bodies.piece[n].empty() && !haptics::Bodies::isRest(bodies.X_PQ[n]))
      bodies.piece[n] = whereItLies(grid, bodies.piece[n], bodies.X_PQ[n]);
}

BodiesCopy copyOf(const haptics::Bodies& bodies, const haptics::Tick& newest) {
  BodiesCopy copy = copyOfPieces(bodies, newest);
  copy.jaw = bodies.jaw().copyBox(glm::ivec3(0), bodies.grid().size);
  if (bodies.bones().size() > 1) layWhereTheyAre(copy, bodies.bones()[1].grid());
  return copy;
}

std::vector<std::uint8_t> piecesOf(const BodiesCopy& bodies, const assets::VolumeGrid& grid) {
  std::vector<std::uint8_t> solid(grid.voxelCount(), 0);
  for (std::size_t v = 0; v < solid.size(); ++v) {
    int sum = 0;
    for (const auto& piece : bodies.piece) sum += piece.empty() ? 0 : piece[v];
    solid[v] = static_cast<std::uint8_t>(std::min(sum, 255));
  }
  partBodies(bodies, grid, solid);
  return solid;
}

}  // namespace app
