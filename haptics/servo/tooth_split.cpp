#include "haptics/servo/tooth_split.h"

#include <algorithm>
#include <cassert>
#include <utility>

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

void ToothSplit::begin(Bodies& bodies, std::size_t piece, const SplitPlan& plan, StrokeHistory& strokes) noexcept {
  plan_ = &plan;
  from_ = piece;
  to_ = bodies.pieces();
  next_ = 0;
  has_just_begun_ = true;
  // An empty piece may have been somewhere else before.
  bodies.place(to_, bodies.pose(piece));
  strokes.reopen();
}

void ToothSplit::breakOff(Bodies& bodies, std::size_t piece, const SplitPlan& plan, StrokeHistory& strokes) noexcept {
  assert(!isRunning() && bodies.pieces() < kMaxPieces);
  begin(bodies, piece, plan, strokes);
}

bool ToothSplit::step(Bodies& bodies, bool clear, StrokeHistory& strokes) noexcept {
  if (answer_ == SplitAnswer::waiting && !isRunning()) {
    if (!isPossible(bodies))
      answer_ = SplitAnswer::refused;
    else if (clear) {
      answer_ = SplitAnswer::running;
      begin(bodies, order_.piece, *order_.plan, strokes);
    }
  }
  begun_.reset();
  if (std::exchange(has_just_begun_, false)) begun_ = Begun{from_, to_};
  if (!isRunning()) return false;

  // Without a stroke there is nothing to undo, and what was solid apart at first stays so.
  StrokeHistory* const kept = strokes.strokes() > 0 ? &strokes : nullptr;
  const std::size_t blocks = bodies.bones()[from_ + 1].blocks();
  const std::size_t end = std::min(next_ + kBlocksPerTick, plan_->blocks.size());
  for (; next_ < end; ++next_) {
    const SplitPlan::Block& planned = plan_->blocks[next_];
    if (planned.block < blocks) bodies.moveBlock(from_, to_, planned.block, planned.given, kept);
  }
  if (next_ == plan_->blocks.size()) {
    plan_ = nullptr;
    if (answer_ == SplitAnswer::running) answer_ = SplitAnswer::done;
    strokes.endStroke();
  }
  return true;
}

}  // namespace haptics
