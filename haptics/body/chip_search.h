// Finds chips while bone and tooth are cut: components of less than kLeastPiece_mm3 that hung together with more at
// first, so that islands of marrow in the scan are none. Kept up to date brick by brick. One thread, not the servo's:
// it keeps copies. Construction 50 ns a voxel; 1 us a changed brick; a plan some ms for a jaw; allocates. The plan is a
// function of the bytes at first and now, whatever the way between: a replay finds the same.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "haptics/body/bodies.h"
#include "haptics/body/chip_plan.h"
#include "haptics/body/components.h"

namespace haptics {

/// Bytes of the bodies before the first cut.
struct FirstBytes {
  assets::VolumeGrid grid, piece_grid;   ///< the latter of size 0: no tooth
  std::vector<std::uint8_t> jaw, tooth;  ///< in the order of these
  glm::ivec3 first_brick{0};             ///< of the jaw's grid, where the tooth's begins

  explicit FirstBytes(const Bodies& bodies);
};

class ChipSearch {
 public:
  explicit ChipSearch(const FirstBytes& first);

  using Brick = std::array<std::uint8_t, 512>;
  /// A changed brick of a bone (in the order of Bodies::bones()), in its own grid.
  void update(std::size_t bone, glm::ivec3 brick, const Brick& solid) { now_[bone].update(brick, solid); }
  /// At most kMostChips, the jaw's first; empty: there are none.
  ChipPlan plan();

 private:
  void addChips(std::size_t bone, ChipPlan& plan);

  std::vector<Components> now_;                  ///< by bone
  std::array<std::vector<BrickMask>, 2> whole_;  ///< of jaw and tooth: what was part of a larger component at first
};

inline constexpr std::size_t kMostChips = 512;

/// A brick of the jaw's grid given to the search: that of the jaw and those of the pieces there.
void giveBrick(const Bodies& bodies, glm::ivec3 brick, ChipSearch& search);

}  // namespace haptics
