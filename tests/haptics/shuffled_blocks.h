// The blocks of a field in other slots: in random order with gaps, those of unlabelled air in one.
#pragma once

#include <algorithm>
#include <cstring>
#include <numeric>
#include <random>
#include <vector>

#include "haptics/bone/solid_field.h"

namespace haptics::phantom {

class ShuffledBlocks {
 public:
  ShuffledBlocks(const SolidField& field, unsigned seed) : field_(field) {
    const std::size_t blocks = field.blockAt({0, 0, field.blocks.z}), slots = 2 * blocks + 1;
    std::vector<std::uint32_t> order(slots - 1);
    std::iota(order.begin(), order.end(), 1U);
    std::shuffle(order.begin(), order.end(), std::mt19937(seed));
    slot_of_.assign(blocks + 1, 0);
    solid_.assign(slots * kBlockVoxels, 0), label_.assign(slots * kBlockVoxels, 0), only_label_.assign(slots, 0);
    for (auto& sums : sums_) sums.assign(slots, 0);
    grey_.assign(slots, 0);
    for (std::size_t block = 0; block < blocks; ++block) {
      const std::size_t from = field.slotOf(block);
      if (field.weight[from] == 0 && field.only_label[from] == 0) continue;
      const std::size_t to = slot_of_[block] = order[block];
      std::memcpy(&solid_[to * kBlockVoxels], field.solid + from * kBlockVoxels, kBlockVoxels);
      if (field.label != nullptr)
        std::memcpy(&label_[to * kBlockVoxels], field.label + from * kBlockVoxels, kBlockVoxels);
      only_label_[to] = field.only_label[from];
      sums_[0][to] = field.weight[from], sums_[1][to] = field.weight_x[from];
      sums_[2][to] = field.weight_y[from], sums_[3][to] = field.weight_z[from];
      grey_[to] = field.grey[from];
    }
  }

  SolidField field() const {
    return {field_.grid,
            field_.blocks,
            slot_of_.data(),
            solid_.data(),
            field_.label == nullptr ? nullptr : label_.data(),
            sums_[0].data(),
            sums_[1].data(),
            sums_[2].data(),
            sums_[3].data(),
            grey_.data(),
            only_label_.data()};
  }

 private:
  SolidField field_;
  std::vector<std::uint32_t> slot_of_, grey_;
  std::vector<std::uint8_t> solid_, label_, only_label_;
  std::vector<std::uint16_t> sums_[4];
};

}  // namespace haptics::phantom
