// Chips: what has come off bone and tooth in pieces of less than kLeastPiece_mm3, and what their going takes from the
// volumes. Found on a worker (chip_search.h), taken away by the servo block by block (servo/chip_removal), loose
// particles from then on. Plain values. Frame of each body, mm.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "haptics/body/solid_bodies.h"
#include "haptics/body/split_plan.h"

namespace haptics {

struct Chip {
  std::size_t bone = 0;         ///< in the order of Bodies::bones(): 0 of the jaw, else of a piece of tooth
  std::uint32_t bytes = 0;      ///< solid, of 255 a voxel
  double volume_mm3 = 0.0;      ///< of these bytes
  glm::dvec3 centroid_mm{0.0};  ///< of its voxels of at least half
  glm::ivec3 voxel{0};          ///< the first of these, in its body's grid

  bool operator==(const Chip&) const = default;
};

struct ChipPlan {
  std::vector<Chip> chips;                  ///< the jaw's first, the largest of each first
  std::array<SplitPlan, kMaxBodies> taken;  ///< by bone: the bytes of all chips together
  std::uint64_t digest = 0;                 ///< equal plans have equal ones

  bool operator==(const ChipPlan&) const = default;
};

}  // namespace haptics
