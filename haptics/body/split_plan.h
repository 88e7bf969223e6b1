// What comes off a piece of tooth when it falls apart: made on a worker (piece_split.h), carried out by the servo block
// by block. Blocks of the tooth's grid (bone/cubelets). Plain values.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "haptics/bone/solid_field.h"

namespace haptics {

struct SplitPlan {
  struct Block {
    std::uint32_t block = 0;
    std::array<std::uint8_t, kBlockVoxels> given{};  ///< of each voxel's solid

    bool operator==(const Block&) const = default;
  };
  std::vector<Block> blocks;  ///< ascending, each once

  bool operator==(const SplitPlan&) const = default;
};

}  // namespace haptics
