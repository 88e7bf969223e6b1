#include "haptics/bone/stroke_history.h"

#include <algorithm>

namespace haptics {
namespace {

/// One stroke may use 1/4 of the capacity, so that older ones survive while it grows.
constexpr std::size_t kMaxStrokeShare = 4;

}  // namespace

StrokeHistory::StrokeHistory(const CarvedBone& bone, std::size_t max_blocks) {
  const glm::ivec3 blocks = bone.field().blocks;
  const std::size_t all = bone.field().blockAt({0, 0, blocks.z});
  saved_in_.assign(all, 0);
  saved_.resize(std::max(kMaxStrokeShare, std::min(kMaxStrokeShare * all, max_blocks)));
}

void StrokeHistory::save(std::size_t block, const BlockState& state) noexcept {
  if (open_ && newest().blocks == saved_.size() / kMaxStrokeShare) endStroke();
  if (!open_) beginStroke();
  while (saved_count_ == saved_.size()) dropOldest();
  Stroke& stroke = newest();
  Saved& saved = saved_[(stroke.first + stroke.blocks) % saved_.size()];
  saved.state = state;
  saved.block = static_cast<std::uint32_t>(block);
  saved_in_[block] = stroke_;
  ++stroke.blocks;
  ++saved_count_;
}

void StrokeHistory::beginStroke() noexcept {
  if (count_ == kMaxStrokes) dropOldest();
  const std::size_t first = count_ == 0 ? 0 : (newest().first + newest().blocks) % saved_.size();
  ++count_;
  newest() = {first, 0};
  open_ = true;
}

void StrokeHistory::endStroke() noexcept {
  if (!open_) return;
  open_ = false;
  ++stroke_;
}

void StrokeHistory::dropOldest() noexcept {
  saved_count_ -= strokes_[oldest_].blocks;
  oldest_ = (oldest_ + 1) % kMaxStrokes;
  --count_;
}

StrokeHistory::Restored StrokeHistory::restore(CarvedBone& bone, std::size_t max_blocks) noexcept {
  endStroke();
  Restored restored;
  if (count_ == 0) return restored;
  Stroke& stroke = newest();
  std::int64_t steps = 0;
  for (; restored.blocks < max_blocks && stroke.blocks > 0; ++restored.blocks) {
    const Saved& saved = saved_[(stroke.first + --stroke.blocks) % saved_.size()];
    steps += bone.restoreBlock(saved.block, saved.state);
    --saved_count_;
  }
  if (stroke.blocks == 0) --count_;
  restored.volume_mm3 = static_cast<double>(steps) * bone.grid().voxelVolume_mm3() / 255.0;
  return restored;
}

}  // namespace haptics
