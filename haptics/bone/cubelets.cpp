#include "haptics/bone/cubelets.h"

#include <cassert>
#include <cstring>

namespace haptics {

Cubelets::Cubelets(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid,
                   std::span<const std::uint8_t> label)
    : grid_(grid), blocks_((grid.size + (kBlockEdge - 1)) / kBlockEdge) {
  assert(solid.size() == grid.voxelCount());
  assert(label.empty() || label.size() == grid.voxelCount());
  const std::size_t count = field().blockAt({0, 0, blocks_.z});
  solid_.assign(count * kBlockVoxels, 0);
  if (!label.empty()) label_.assign(count * kBlockVoxels, 0);
  only_label_.assign(count, 0);
  weight_.assign(count, 0);
  weight_x_ = weight_y_ = weight_z_ = weight_;
  grey_.assign(count, 0);

  const SolidField at = field();
  for (int k = 0; k < grid.size.z; ++k)
    for (int j = 0; j < grid.size.y; ++j)
      for (int i = 0; i < grid.size.x; ++i) {
        const std::size_t from = grid.index({i, j, k}), to = at.offsetOf({i, j, k}), block = to / kBlockVoxels;
        solid_[to] = solid[from];
        if (label.empty()) continue;
        label_[to] = label[from];
        const bool first = ((i | j | k) & 3) == 0;
        if (first) only_label_[block] = label[from];
        if (only_label_[block] != label[from]) only_label_[block] = kMixedLabels;
      }
  for (std::size_t block = 0; block < count; ++block) sumBlock(block, solid_.data() + block * kBlockVoxels);
}

SolidField Cubelets::field() const {
  return {grid_,
          blocks_,
          nullptr,
          solid_.data(),
          label_.empty() ? nullptr : label_.data(),
          weight_.data(),
          weight_x_.data(),
          weight_y_.data(),
          weight_z_.data(),
          grey_.data(),
          only_label_.data()};
}

void Cubelets::sumBlock(std::size_t block, const std::uint8_t* solid) {
  std::uint32_t weight = 0, x = 0, y = 0, z = 0, grey = 0;
  for (std::uint32_t n = 0; n < kBlockVoxels; ++n) {
    const std::uint32_t w = solid[n];
    weight += w;
    x += w * (n & 3);
    y += w * (n >> 2 & 3);
    z += w * (n >> 4);
    grey += w * (255 - w);
  }
  weight_[block] = static_cast<std::uint16_t>(weight);
  weight_x_[block] = static_cast<std::uint16_t>(x);
  weight_y_[block] = static_cast<std::uint16_t>(y);
  weight_z_[block] = static_cast<std::uint16_t>(z);
  grey_[block] = grey;
}

void Cubelets::setBlock(std::size_t block, const std::array<std::uint8_t, kBlockVoxels>& solid) {
  sumBlock(block, solid.data());
  // Whole words, relaxed: a reader sees the old or the new value of every byte.
  using Word __attribute__((may_alias)) = std::uint64_t;
  auto* const words = static_cast<Word*>(static_cast<void*>(solid_.data() + block * kBlockVoxels));
  for (std::size_t n = 0; n < kBlockVoxels / sizeof(Word); ++n) {
    Word word;
    std::memcpy(&word, solid.data() + n * sizeof(Word), sizeof(Word));
    __atomic_store_n(words + n, word, __ATOMIC_RELAXED);
  }
}

}  // namespace haptics
