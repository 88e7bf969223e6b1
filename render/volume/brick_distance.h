// How far from every brick the next marked one lies, by the chessboard's (Chebyshev) distance: what a ray may pass
// unseen. Grows the marked set by one brick at a time, 64 bricks a word. Pure; allocates two bits a brick; about 0.1 ms
// for the 32^3 bricks of 256^3 voxels.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

namespace render {

/// `marked`: not 0 where marked, i fastest. Writes 0 there, elsewhere the distance in bricks, at most `farthest`.
void distancesInBricks(glm::ivec3 size, std::span<const std::uint8_t> marked, int farthest,
                       std::span<std::uint8_t> distance);

}  // namespace render
