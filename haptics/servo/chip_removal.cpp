#include "haptics/servo/chip_removal.h"

namespace haptics {

bool ChipRemoval::isPossible(const Bodies& bodies) const noexcept {
  return order_.plan != nullptr && !order_.plan->chips.empty() && order_.plan->digest == order_.plan_digest &&
         bodies.digest() == order_.bodies_digest;
}

void ChipRemoval::receive(const Bodies& bodies, const ChipOrder& order) noexcept {
  // One that runs is finished first.
  if (isRunning() || order.serial == order_.serial) return;
  order_ = order;
  answer_ = isPossible(bodies) ? ChipAnswer::waiting : ChipAnswer::refused;
}

double ChipRemoval::step(Bodies& bodies, bool clear, StrokeHistory& strokes) noexcept {
  changed_ = false;
  if (answer_ == ChipAnswer::waiting) {
    if (!isPossible(bodies)) {
      answer_ = ChipAnswer::refused;
    } else if (clear) {
      answer_ = ChipAnswer::running;
      bone_ = next_ = 0;
      strokes.reopen();
    }
  }
  if (!isRunning()) return 0.0;

  // Without a stroke there is nothing to undo.
  changed_ = true;
  StrokeHistory* const kept = strokes.strokes() > 0 ? &strokes : nullptr;
  double lost_mm3 = 0.0;
  const std::size_t bones = bodies.bones().size();
  for (std::size_t left = kBlocksPerTick; left > 0 && bone_ < order_.plan->taken.size();) {
    const SplitPlan& taken = order_.plan->taken[bone_];
    if (next_ == taken.blocks.size() || bone_ >= bones) {
      ++bone_;
      next_ = 0;
      continue;
    }
    const SplitPlan::Block& block = taken.blocks[next_++];
    if (block.block < bodies.bones()[bone_].blocks())
      lost_mm3 += bodies.loseBlock(bone_, block.block, block.given, kept);
    --left;
  }
  if (bone_ == order_.plan->taken.size()) {
    answer_ = ChipAnswer::done;
    strokes.endStroke();
  }
  return lost_mm3;
}

}  // namespace haptics
