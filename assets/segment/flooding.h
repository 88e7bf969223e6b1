// Watershed from markers (Meyer 1994): labels grow from their first cells over the mask in the order of rising levels,
// first come, first served within a level; a queue per level. ITK's MorphologicalWatershedFromMarkers knows no mask and
// takes ten times as long over a whole jaw. Serial, deterministic, 50 ns a cell. Any thread but the servo.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "assets/segment/cell_masks.h"

namespace assets {

/// `label`: 0 to be flooded; where `may_flood` is 0 it stays as it is. `level`: a few thousand at most.
void flood(glm::ivec3 size, std::span<const std::uint16_t> level, std::span<const std::uint8_t> may_flood,
           std::vector<std::uint8_t>& label);

}  // namespace assets
