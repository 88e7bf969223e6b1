// A copy of the live bodies for a worker that plans or searches while the servo goes on writing. Frame P, mm. copyOf()
// and copyOfPieces(): a reading thread, 30 ms with the jaw, 2 to 8 ms a piece without; the others: any thread.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "haptics/body/bodies.h"
#include "haptics/servo/tick.h"

namespace app {

/// Bytes of the bodies, in the order of their grids.
struct BodiesCopy {
  std::vector<std::uint8_t> jaw;
  /// On the tooth's grid, where each piece lies; empty: not there, or set aside.
  std::array<std::vector<std::uint8_t>, haptics::kMaxPieces> piece;
  std::array<haptics::PiecePose, haptics::kMaxPieces> X_PQ{};
  bool is_any_out = false;  ///< a piece was set aside
};
/// As a reading thread sees them while nothing changes; poses and number of pieces are the newest tick's.
BodiesCopy copyOf(const haptics::Bodies& bodies, const haptics::Tick& newest);
/// Without the jaw, each piece as if it were at rest.
BodiesCopy copyOfPieces(const haptics::Bodies& bodies, const haptics::Tick& newest);
/// Those pieces to their poses: the nearest voxel counts. What lies beyond the grid is lost.
void layWhereTheyAre(BodiesCopy& bodies, const assets::VolumeGrid& grid);

/// All pieces as one volume, a voxel's gap between those that touch, as along a break: they stay pieces.
std::vector<std::uint8_t> piecesOf(const BodiesCopy& bodies, const assets::VolumeGrid& grid);

}  // namespace app
