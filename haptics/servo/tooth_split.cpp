#include "haptics/servo/tooth_split.h"

#include <algorithm>

namespace haptics {

bool ToothSplit::isPossible(const Bodies& bodies) const noexcept {
  return order_.plan != nullptr && !order_.plan->blocks.empty() && order_.piece < bodies.pieces() &&
         bodies.pieces() < kMaxPieces && bodies.digest() == order_.bodies_digest;
}

void ToothSplit::receive(const Bodies& bodies, const SplitOrder& order) noexcept {
  // One that runs is finished first.
  if (isRunning() || order.serial == order_.serial) return;
  order_ = order;
  answer_ = isPossible(bodies) ? SplitAnswer::waiting : SplitAnswer::refused;
}

bool ToothSplit::step(Bodies& bodies, bool clear, StrokeHistory& strokes) noexcept {
  begun_.reset();
  if (answer_ == SplitAnswer::waiting) {
    if (!isPossible(bodies))
      answer_ = SplitAnswer::refused;
    else if (clear) {
      answer_ = SplitAnswer::running;
      to_ = bodies.pieces();
      next_ = 0;
      begun_ = Begun{static_cast<std::size_t>(order_.piece), to_};
      // An empty piece may have been somewhere else before.
      bodies.place(to_, bodies.pose(order_.piece));
      strokes.reopen();
    }
  }
  if (!isRunning()) return false;

  // Without a stroke there is nothing to undo, and what was solid apart at first stays so.
  StrokeHistory* const kept = strokes.strokes() > 0 ? &strokes : nullptr;
  const std::size_t blocks = bodies.bones()[order_.piece + 1].blocks();
  const std::size_t end = std::min(next_ + kBlocksPerTick, order_.plan->blocks.size());
  for (; next_ < end; ++next_) {
    const SplitPlan::Block& planned = order_.plan->blocks[next_];
    if (planned.block < blocks) bodies.moveBlock(order_.piece, to_, planned.block, planned.given, kept);
  }
  if (next_ == order_.plan->blocks.size()) {
    answer_ = SplitAnswer::done;
    strokes.endStroke();
  }
  return true;
}

}  // namespace haptics
