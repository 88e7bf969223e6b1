// The cheapest way between two sets of cells (Dijkstra over the 26 neighbours): a step costs its length times the mean
// cost of both cells. Serial, deterministic; 0.5 µs a cell that is reached. Any thread but the servo.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "assets/volume_grid.h"

namespace assets {

/// Cells from one of `from` to one of `to`; empty where no way leads. Cells with a cost that is not positive are
/// barred.
std::vector<std::size_t> cheapestPath(glm::ivec3 size, std::span<const float> cost, std::span<const std::size_t> from,
                                      std::span<const std::size_t> to);

}  // namespace assets
