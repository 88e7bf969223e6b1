// Squared Euclidean distance from every cell of a grid to the nearest chosen one: lower envelopes of parabolas along
// each axis (Felzenszwalb and Huttenlocher, Theory of Computing 8:415, 2012). Exact. Parallel over lines (TBB); 20 ns a
// cell. Any thread.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace assets {

/// In cells squared; infinity where nothing is chosen. `is_chosen`: not 0, i fastest.
std::vector<float> squaredDistance(glm::ivec3 size, std::span<const std::uint8_t> is_chosen);

}  // namespace assets
