#include "haptics/bone/stroke_history.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "haptics/bone/filling.h"

namespace haptics {
namespace {

/// One stroke may use 1/4 of the capacity, so that older ones survive while it grows.
constexpr std::size_t kMaxStrokeShare = 4;

}  // namespace

StrokeHistory::StrokeHistory(std::span<const CarvedBone> bones, std::size_t max_blocks, const Filling* filling) {
  std::size_t all = filling == nullptr ? 0 : filling->blocks();
  for (const CarvedBone& bone : bones) all += bone.blocks();
  saved_in_.assign(all, 0);
  saved_.resize(std::max(kMaxStrokeShare, std::min(kMaxStrokeShare * all, max_blocks)));
}

void StrokeHistory::save(std::size_t block, const BlockState& state) noexcept {
  if (open_ && newest().blocks == saved_.size() / kMaxStrokeShare) endStroke();
  if (!open_) beginStroke(false);
  while (saved_count_ == saved_.size()) dropOldest();
  Stroke& stroke = newest();
  Saved& saved = saved_[(stroke.first + stroke.blocks) % saved_.size()];
  saved.state = state;
  saved.block = static_cast<std::uint32_t>(block);
  saved_in_[block] = stroke_;
  ++stroke.blocks;
  ++saved_count_;
}

void StrokeHistory::beginStroke(bool marked) noexcept {
  dropUndone();
  if (count_ == kMaxStrokes) dropOldest();
  const std::size_t first = count_ == 0 ? 0 : (newest().first + newest().blocks) % saved_.size();
  ++count_;
  newest() = {first, 0, 0, marked};
  open_ = true;
}

void StrokeHistory::addMarked() noexcept {
  endStroke();
  beginStroke(true);
  endStroke();
}

void StrokeHistory::reopen() noexcept {
  if (open_) return;
  dropUndone();
  open_ = count_ > 0;
}

void StrokeHistory::endStroke() noexcept {
  if (!open_) return;
  open_ = false;
  ++stroke_;
}

void StrokeHistory::dropOldest() noexcept {
  assert(count_ > 0);
  saved_count_ -= strokes_[oldest_].blocks;
  oldest_ = (oldest_ + 1) % kMaxStrokes;
  --count_;
}

/// Undone strokes, and the undone part of the newest.
void StrokeHistory::dropUndone() noexcept {
  for (; undone_ > 0; --undone_) saved_count_ -= strokes_[(oldest_ + count_ + undone_ - 1) % kMaxStrokes].blocks;
  if (count_ == 0) return;
  Stroke& stroke = newest();
  saved_count_ -= stroke.undone;
  stroke.blocks -= std::exchange(stroke.undone, 0);
  if (stroke.blocks == 0 && !stroke.marked) --count_;
}

std::int64_t StrokeHistory::exchange(std::span<CarvedBone> bones, Filling* filling, std::size_t entry) noexcept {
  Saved& saved = saved_[entry % saved_.size()];
  // The bone of this block, and its number there.
  std::size_t at = 0, block = saved.block;
  for (; at < bones.size() && block >= bones[at].blocks(); ++at) block -= bones[at].blocks();
  if (at == bones.size()) {
    assert(filling != nullptr);
    const BlockState before = filling->stateOf(block);
    filling->restoreBlock(block, saved.state);
    saved.state = before;
    return 0;
  }
  const BlockState now = bones[at].stateOf(block);
  const std::int64_t steps = bones[at].restoreBlock(block, saved.state);
  saved.state = now;
  return steps;
}

StrokeHistory::Restored StrokeHistory::undo(std::span<CarvedBone> bones, std::size_t max_blocks,
                                            Filling* filling) noexcept {
  endStroke();
  Restored restored;
  if (count_ == 0) return restored;
  Stroke& stroke = newest();
  std::int64_t steps = 0;
  for (; restored.blocks < max_blocks && stroke.undone < stroke.blocks; ++restored.blocks)
    steps += exchange(bones, filling, stroke.first + stroke.blocks - ++stroke.undone);
  if (stroke.undone == stroke.blocks) {
    --count_;
    ++undone_;
  }
  restored.volume_mm3 = static_cast<double>(steps) * bones.front().grid().voxelVolume_mm3() / 255.0;
  return restored;
}

StrokeHistory::Restored StrokeHistory::redo(std::span<CarvedBone> bones, std::size_t max_blocks,
                                            Filling* filling) noexcept {
  endStroke();
  Restored restored;
  if (!isBetweenStrokes()) {
    if (undone_ == 0) return restored;
    --undone_;
    ++count_;
  }
  Stroke& stroke = newest();
  std::int64_t steps = 0;
  for (; restored.blocks < max_blocks && stroke.undone > 0; ++restored.blocks)
    steps += exchange(bones, filling, stroke.first + stroke.blocks - stroke.undone--);
  restored.volume_mm3 = static_cast<double>(steps) * bones.front().grid().voxelVolume_mm3() / 255.0;
  return restored;
}

}  // namespace haptics
