#include "haptics/bone/stroke_history.h"

#include <algorithm>

namespace haptics {
namespace {

/// Of the room, that one stroke may take: the others still have theirs while it grows.
constexpr std::size_t kLargestShare = 4;

}  // namespace

StrokeHistory::StrokeHistory(const CarvedBone& bone, std::size_t max_blocks) {
  const glm::ivec3 blocks = bone.field().blocks;
  const std::size_t all = bone.field().blockAt({0, 0, blocks.z});
  saved_in_.assign(all, 0);
  saved_.resize(std::max(kLargestShare, std::min(kLargestShare * all, max_blocks)));
}

void StrokeHistory::save(std::size_t block, const BlockState& state) noexcept {
  if (on_ && newest().blocks == saved_.size() / kLargestShare) endStroke();
  if (!on_) beginStroke();
  while (saved_count_ == saved_.size()) forgetOldest();
  Stroke& stroke = newest();
  Saved& saved = saved_[(stroke.first + stroke.blocks) % saved_.size()];
  saved.state = state;
  saved.block = static_cast<std::uint32_t>(block);
  saved_in_[block] = stroke_;
  ++stroke.blocks;
  ++saved_count_;
}

void StrokeHistory::beginStroke() noexcept {
  if (count_ == kMaxStrokes) forgetOldest();
  const std::size_t first = count_ == 0 ? 0 : (newest().first + newest().blocks) % saved_.size();
  ++count_;
  newest() = {first, 0};
  on_ = true;
}

void StrokeHistory::endStroke() noexcept {
  if (!on_) return;
  on_ = false;
  ++stroke_;
}

void StrokeHistory::forgetOldest() noexcept {
  saved_count_ -= strokes_[oldest_].blocks;
  oldest_ = (oldest_ + 1) % kMaxStrokes;
  --count_;
}

StrokeHistory::Restored StrokeHistory::restore(CarvedBone& bone, std::size_t max_blocks) noexcept {
  endStroke();
  Restored given;
  if (count_ == 0) return given;
  Stroke& stroke = newest();
  std::int64_t steps = 0;
  for (; given.blocks < max_blocks && stroke.blocks > 0; ++given.blocks) {
    const Saved& saved = saved_[(stroke.first + --stroke.blocks) % saved_.size()];
    steps += bone.restoreBlock(saved.block, saved.state);
    --saved_count_;
  }
  if (stroke.blocks == 0) --count_;
  given.volume_mm3 = static_cast<double>(steps) * bone.grid().voxelVolume_mm3() / 255.0;
  return given;
}

}  // namespace haptics
