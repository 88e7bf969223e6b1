#include "app/procedure/root_canal/tooth_blocks.h"

#include <algorithm>

namespace app {
namespace {

constexpr std::uint32_t wordOf(std::uint8_t solid, std::uint8_t label) { return std::uint32_t{label} << 8 | solid; }

}  // namespace

ToothBlocks::ToothBlocks(const assets::ToothSampler& tooth)
    : grid_(tooth.grid()), blocks_(grid_.size / kEdge), index_(assets::countIn(blocks_)) {
  static_assert(kEdge == assets::ToothSampler::kEdge && kVoxels == assets::ToothSampler::kVoxels);
  assets::forBlocks(
      tooth,
      [&](glm::ivec3 block, assets::ToothSampler::Same same) {
        index_[assets::indexIn(blocks_, block)] = wordOf(same.solid, same.label);
      },
      [&](glm::ivec3 block, const Bytes& solid, const Bytes& label) {
        const auto all = [](const Bytes& bytes) {
          return std::ranges::all_of(bytes, [&](std::uint8_t byte) { return byte == bytes[0]; });
        };
        std::uint32_t& word = index_[assets::indexIn(blocks_, block)];
        word = wordOf(solid[0], label[0]);
        if (all(solid) && all(label)) return;
        word = kKept | static_cast<std::uint32_t>(solid_.size());
        solid_.push_back(solid);
        label_.push_back(label);
      });
}

FineSolid::Block ToothBlocks::block(glm::ivec3 block) const {
  const std::uint32_t word = wordAt(block);
  if ((word & kKept) == 0) return {nullptr, static_cast<std::uint8_t>(word & 255u)};
  return {solid_[word & ~kKept].data(), 0};
}

FineSolid::Block ToothBlocks::labels(glm::ivec3 block) const {
  const std::uint32_t word = wordAt(block);
  if ((word & kKept) == 0) return {nullptr, static_cast<std::uint8_t>(word >> 8 & 255u)};
  return {label_[word & ~kKept].data(), 0};
}

}  // namespace app
