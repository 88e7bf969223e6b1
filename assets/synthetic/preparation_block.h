// Blocks for practising tooth preparation: a plain crown as a typodont's, a rounded square of 10 by 9 mm and 7 mm high,
// 1.5 mm of enamel over dentine without pulp, standing alone on a base, with one task each: a slot, a groove with a
// box, a stump. Measured as a tooth is, against the ideal by the same rules; numbered 46. Frame P, mm, the middle of
// the biting surface at the origin, leaning towards the surgeon's eye as practice blocks do. Any thread; some 0.5 s.
#pragma once

#include <array>
#include <string_view>

#include "assets/patient.h"

namespace assets {

struct PreparationBlock {
  std::string_view key;          ///< in sessions and as a case: "block-slot"
  std::string_view title;        ///< of the patient
  std::string_view instruction;  ///< for the surgeon, one line
  std::string_view ideal;        ///< the rule that it is measured by
};
inline constexpr std::array<PreparationBlock, 3> kPreparationBlocks{
    {{"block-slot", "practice block: a slot", "Cut a slot within the drawn outline, 1.5 mm wide and 2 mm deep",
      "class-1"},
     {"block-box", "practice block: a groove and a box",
      "Cut a groove 1.5 mm wide and 2 mm deep, and a box at its mesial end down to the drawn line", "class-2:mesial"},
     {"block-stump", "practice block: a stump",
      "Prepare a stump down to the drawn line: 1.5 mm off its top, a margin of 1 mm, walls converging by 12 degrees",
      "crown:all-ceramic"}}};
/// nullptr: there is no such block.
const PreparationBlock* preparationBlockOf(std::string_view key);

inline constexpr int kPreparationBlockTooth = 46;
inline constexpr double kPreparationBlockVoxel_mm = 0.08;
inline constexpr double kBlockCrown_mm = 7.0, kBlockEnamel_mm = 1.5;
inline constexpr glm::dvec2 kBlockHalf_mm{5.0, 4.5};

Patient preparationBlock(const PreparationBlock& block, double spacing_mm = kPreparationBlockVoxel_mm);

/// Signed distance to the crown in its tooth's frame, without the base; negative inside.
double toBlockCrown_mm(const glm::dvec3& p_mm);

}  // namespace assets
