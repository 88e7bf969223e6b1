#include "haptics/bone/cubelets.h"

#include <algorithm>
#include <cassert>
#include <cstring>

namespace haptics {
namespace {

/// Blocks along the edge of the cubes in whose order slots are given: a file moves within few pages.
constexpr int kCube = 4;

using Bytes = std::array<std::uint8_t, kBlockVoxels>;

bool isEven(const Bytes& bytes) {
  return std::all_of(bytes.begin(), bytes.end(), [&](std::uint8_t one) { return one == bytes[0]; });
}

/// The voxels of a block; 0 outside the grid.
void takeBlock(const assets::VolumeGrid& grid, std::span<const std::uint8_t> from, glm::ivec3 block, Bytes& out) {
  out.fill(0);
  if (from.empty()) return;
  const glm::ivec3 first = block * kBlockEdge, count = glm::min(grid.size - first, glm::ivec3(kBlockEdge));
  for (int k = 0; k < count.z; ++k)
    for (int j = 0; j < count.y; ++j) {
      const std::uint8_t* const row = from.data() + grid.index(first + glm::ivec3(0, j, k));
      std::copy(row, row + count.x, out.begin() + 16 * k + 4 * j);
    }
}

/// Whole words, relaxed: a reader sees the old or the new value of every byte.
void store(std::uint8_t* to, const Bytes& bytes) {
  using Word __attribute__((may_alias)) = std::uint64_t;
  auto* const words = static_cast<Word*>(static_cast<void*>(to));
  for (std::size_t n = 0; n < kBlockVoxels / sizeof(Word); ++n) {
    Word word;
    std::memcpy(&word, bytes.data() + n * sizeof(Word), sizeof(Word));
    __atomic_store_n(words + n, word, __ATOMIC_RELAXED);
  }
}

}  // namespace

Cubelets::Cubelets(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid,
                   std::span<const std::uint8_t> label, BlockStorage storage)
    : grid_(grid), blocks_((grid.size + (kBlockEdge - 1)) / kBlockEdge) {
  assert(solid.size() == grid.voxelCount());
  assert(label.empty() || label.size() == grid.voxelCount());
  blocks_count_ = field().blockAt({0, 0, blocks_.z});
  if (storage == BlockStorage::dense)
    fillDense(solid, label);
  else
    fillSparse(solid, label);
}

Cubelets::Cubelets(const assets::VolumeGrid& grid, std::size_t reserve)
    : grid_(grid), blocks_((grid.size + (kBlockEdge - 1)) / kBlockEdge) {
  blocks_count_ = field().blockAt({0, 0, blocks_.z});
  slots_used_ = shared_ = 1;
  resize(1 + reserve, true);
  slot_of_.assign(blocks_count_ + 1, 0);
}

void Cubelets::resize(std::size_t slots, bool is_labelled) {
  solid_.resize(slots * kBlockVoxels);
  if (is_labelled) label_.resize(slots * kBlockVoxels);
  only_label_.resize(slots);
  weight_.resize(slots);
  weight_x_.resize(slots), weight_y_.resize(slots), weight_z_.resize(slots);
  grey_.resize(slots);
}

void Cubelets::fillDense(std::span<const std::uint8_t> solid, std::span<const std::uint8_t> label) {
  resize(blocks_count_, !label.empty());
  slots_used_ = blocks_count_;
  const SolidField at = field();
  for (int k = 0; k < grid_.size.z; ++k)
    for (int j = 0; j < grid_.size.y; ++j)
      for (int i = 0; i < grid_.size.x; ++i) {
        const std::size_t from = grid_.index({i, j, k}), to = at.offsetOf({i, j, k}), block = to / kBlockVoxels;
        solid_[to] = solid[from];
        if (label.empty()) continue;
        label_[to] = label[from];
        const bool first = ((i | j | k) & 3) == 0;
        if (first) only_label_[block] = label[from];
        if (only_label_[block] != label[from]) only_label_[block] = kMixedLabels;
      }
  for (std::size_t block = 0; block < blocks_count_; ++block) sumSlot(block, solid_.data() + block * kBlockVoxels);
}

/// Twice through the blocks: first what is shared, then the rest.
void Cubelets::fillSparse(std::span<const std::uint8_t> solid, std::span<const std::uint8_t> label) {
  constexpr std::uint32_t kNone = ~0U;
  const SolidField at = field();
  std::vector<std::uint32_t> slot_of(blocks_count_ + 1, kNone), slot_of_kind(1U << 16, kNone);
  std::vector<std::array<std::uint8_t, 2>> kinds;
  const auto shared_slot_of = [&](std::uint8_t byte, std::uint8_t tissue) {
    std::uint32_t& slot = slot_of_kind[static_cast<std::size_t>(byte) << 8 | tissue];
    if (slot == kNone) slot = static_cast<std::uint32_t>(kinds.size()), kinds.push_back({byte, tissue});
    return slot;
  };
  Bytes bytes, labels;
  std::size_t own = 0, even_solid = 0;
  const auto for_blocks = [&](const auto& visit) {
    assets::forVoxels(glm::ivec3(0), (blocks_ + (kCube - 1)) / kCube, [&](glm::ivec3 cube) {
      assets::forVoxels(cube * kCube, glm::min((cube + 1) * kCube, blocks_),
                        [&](glm::ivec3 block) { visit(block, at.blockAt(block)); });
    });
  };
  for_blocks([&](glm::ivec3 block, std::size_t number) {
    takeBlock(grid_, solid, block, bytes);
    takeBlock(grid_, label, block, labels);
    if (!isEven(bytes) || !isEven(labels) || labels[0] == kMixedLabels) {
      ++own;
      return;
    }
    slot_of[number] = shared_slot_of(bytes[0], labels[0]);
    if (bytes[0] == 0) return;
    // What becomes of it when it is cut whole.
    shared_slot_of(0, labels[0]);
    ++even_solid;
  });

  shared_ = static_cast<std::uint32_t>(kinds.size());
  resize(shared_ + own + std::min(even_solid, kReserve), !label.empty());
  for (std::size_t slot = 0; slot < kinds.size(); ++slot) {
    std::fill_n(solid_.begin() + static_cast<std::ptrdiff_t>(slot * kBlockVoxels), kBlockVoxels, kinds[slot][0]);
    if (!label.empty())
      std::fill_n(label_.begin() + static_cast<std::ptrdiff_t>(slot * kBlockVoxels), kBlockVoxels, kinds[slot][1]);
    only_label_[slot] = kinds[slot][1];
  }
  std::size_t next = shared_;
  for_blocks([&](glm::ivec3 block, std::size_t number) {
    if (slot_of[number] != kNone) return;
    slot_of[number] = static_cast<std::uint32_t>(next);
    takeBlock(grid_, solid, block, bytes);
    std::copy(bytes.begin(), bytes.end(), solid_.begin() + static_cast<std::ptrdiff_t>(next * kBlockVoxels));
    if (!label.empty()) {
      takeBlock(grid_, label, block, labels);
      std::copy(labels.begin(), labels.end(), label_.begin() + static_cast<std::ptrdiff_t>(next * kBlockVoxels));
      only_label_[next] = labels[0];
      // Voxels outside the grid do not count.
      assets::forVoxels(block * kBlockEdge, glm::min((block + 1) * kBlockEdge, grid_.size), [&](glm::ivec3 ijk) {
        if (labels[SolidField::within(ijk)] != labels[0]) only_label_[next] = kMixedLabels;
      });
    }
    ++next;
  });
  slots_used_ = next;
  for (std::size_t slot = 0; slot < next; ++slot) sumSlot(slot, solid_.data() + slot * kBlockVoxels);
  slot_of.back() = 0;
  slot_of_ = std::move(slot_of);
}

SolidField Cubelets::field() const {
  return {grid_,
          blocks_,
          slot_of_.empty() ? nullptr : slot_of_.data(),
          solid_.data(),
          label_.empty() ? nullptr : label_.data(),
          weight_.data(),
          weight_x_.data(),
          weight_y_.data(),
          weight_z_.data(),
          grey_.data(),
          only_label_.data()};
}

std::size_t Cubelets::bytes() const {
  constexpr std::size_t kSums = 4 * sizeof(std::uint16_t) + sizeof(std::uint32_t) + sizeof(std::uint8_t);
  return solid_.size() + label_.size() + slots() * kSums + slot_of_.size() * sizeof(std::uint32_t);
}

void Cubelets::sumSlot(std::size_t slot, const std::uint8_t* solid) {
  std::uint32_t weight = 0, x = 0, y = 0, z = 0, grey = 0;
  for (std::uint32_t n = 0; n < kBlockVoxels; ++n) {
    const std::uint32_t w = solid[n];
    weight += w;
    x += w * (n & 3);
    y += w * (n >> 2 & 3);
    z += w * (n >> 4);
    grey += w * (255 - w);
  }
  weight_[slot] = static_cast<std::uint16_t>(weight);
  weight_x_[slot] = static_cast<std::uint16_t>(x);
  weight_y_[slot] = static_cast<std::uint16_t>(y);
  weight_z_[slot] = static_cast<std::uint16_t>(z);
  grey_[slot] = grey;
}

bool Cubelets::own(std::size_t block) {
  if (isOwn(block)) return true;
  if (slots_used_ == slots()) return false;
  const std::size_t from = slot_of_[block], to = slots_used_;
  std::memcpy(solid_.data() + to * kBlockVoxels, solid_.data() + from * kBlockVoxels, kBlockVoxels);
  if (!label_.empty())
    std::memcpy(label_.data() + to * kBlockVoxels, label_.data() + from * kBlockVoxels, kBlockVoxels);
  only_label_[to] = only_label_[from];
  weight_[to] = weight_[from];
  weight_x_[to] = weight_x_[from], weight_y_[to] = weight_y_[from], weight_z_[to] = weight_z_[from];
  grey_[to] = grey_[from];
  __atomic_store_n(&slots_used_, to + 1, __ATOMIC_RELAXED);
  // A reader sees the shared slot or all of this one.
  __atomic_store_n(slot_of_.data() + block, static_cast<std::uint32_t>(to), __ATOMIC_RELEASE);
  return true;
}

bool Cubelets::setBlock(std::size_t block, const std::array<std::uint8_t, kBlockVoxels>& solid) {
  if (!own(block)) {
    // As another shared slot holds it.
    if (!isEven(solid)) return false;
    const std::uint8_t label = only_label_[slot_of_[block]];
    for (std::uint32_t slot = 0; slot < shared_; ++slot) {
      if (only_label_[slot] != label || solid_[slot * kBlockVoxels] != solid[0]) continue;
      __atomic_store_n(slot_of_.data() + block, slot, __ATOMIC_RELEASE);
      return true;
    }
    return false;
  }
  const std::size_t slot = slot_of_.empty() ? block : slot_of_[block];
  sumSlot(slot, solid.data());
  store(solid_.data() + slot * kBlockVoxels, solid);
  return true;
}

void Cubelets::setLabels(std::size_t block, const std::array<std::uint8_t, kBlockVoxels>& label) {
  const std::size_t slot = slot_of_.empty() ? block : slot_of_[block];
  only_label_[slot] = isEven(label) ? label[0] : kMixedLabels;
  store(label_.data() + slot * kBlockVoxels, label);
}

}  // namespace haptics
