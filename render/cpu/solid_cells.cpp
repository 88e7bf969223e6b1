#include "render/cpu/solid_cells.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cstring>

#include "assets/ct_volume.h"
#include "render/volume/brick_distance.h"

namespace render {
namespace {

constexpr int kEdge = SolidCells::kEdge, kSide = kEdge + 1;

/// The voxels that a brick's cells touch, air outside the volume.
struct Block {
  std::uint8_t value[kSide][kSide][kSide];
};

Block voxelsOf(const BorderedField<std::uint8_t>& solid, glm::ivec3 brick) {
  Block block{};
  const glm::ivec3 first = (brick - 1) * kEdge;
  const glm::ivec3 low = glm::max(first, glm::ivec3(0)), high = glm::min(first + kSide, solid.layout().size);
  if (low.x >= high.x) return block;
  for (int k = low.z; k < high.z; ++k)
    for (int j = low.y; j < high.y; ++j)
      std::memcpy(&block.value[k - first.z][j - first.y][low.x - first.x], solid.at({low.x, j, k}),
                  static_cast<std::size_t>(high.x - low.x));
  return block;
}

/// A bit for each eighth of the cells with a corner that is solid.
std::uint8_t solidEighths(const Block& block) {
  static_assert(assets::kHalfSolid == 1 << 7);
  constexpr int kHalf = kEdge / 2;
  std::uint8_t eighths = 0;
  for (int n = 0; n < 8; ++n) {
    const int i = (n & 1) * kHalf, j = ((n >> 1) & 1) * kHalf, k = (n >> 2) * kHalf;
    std::uint8_t high_bits = 0;
    for (int c = k; c <= k + kHalf; ++c)
      for (int b = j; b <= j + kHalf; ++b)
        for (int a = i; a <= i + kHalf; ++a) high_bits |= block.value[c][b][a];
    eighths = static_cast<std::uint8_t>(eighths | (high_bits >> 7 << n));
  }
  return eighths;
}

void fill(const Block& block, std::uint32_t* words) {
  for (int k = 0; k < kEdge; ++k)
    for (int j = 0; j < kEdge; ++j)
      for (int i = 0; i < SolidCells::kRowWords; ++i)
        *words++ = static_cast<std::uint32_t>(block.value[k][j][i] | (block.value[k][j + 1][i] << 8) |
                                              (block.value[k + 1][j][i] << 16)) |
                   (static_cast<std::uint32_t>(block.value[k + 1][j + 1][i]) << 24);
}

}  // namespace

SolidCells::SolidCells(const BorderedField<std::uint8_t>& solid)
    : solid_(&solid), bricks_((solid.layout().size + kEdge - 1) / kEdge + 2) {
  const std::size_t count = index(bricks_ - 1) + 1;
  solid_eighths_.resize(count);
  slot_.assign(count, -1);
  is_touched_.resize(count);

  // Which bricks need cells, then their cells.
  const auto over_layers = [this](auto work) {
    oneapi::tbb::parallel_for(0, bricks_.z, [&](int k) {
      for (int j = 0; j < bricks_.y; ++j)
        for (int i = 0; i < bricks_.x; ++i) work(glm::ivec3(i, j, k));
    });
  };
  over_layers([this](glm::ivec3 brick) { solid_eighths_[index(brick)] = solidEighths(voxelsOf(*solid_, brick)); });
  std::int32_t kept = 0;
  for (std::size_t b = 0; b < count; ++b)
    if (solid_eighths_[b] != 0) slot_[b] = kept++;
  words_.resize(static_cast<std::size_t>(kept) * kBrickWords);
  over_layers([this](glm::ivec3 brick) {
    if (const std::int32_t slot = slot_[index(brick)]; slot >= 0) fill(voxelsOf(*solid_, brick), wordsOf(slot));
  });
  rebuild();
}

std::size_t SolidCells::index(glm::ivec3 brick) const {
  return (static_cast<std::size_t>(brick.z) * static_cast<std::size_t>(bricks_.y) + static_cast<std::size_t>(brick.y)) *
             static_cast<std::size_t>(bricks_.x) +
         static_cast<std::size_t>(brick.x);
}

std::size_t SolidCells::bytes() const {
  return words_.size() * sizeof(std::uint32_t) + slot_.size() * 2 * (1 + sizeof(std::int32_t));
}

void SolidCells::touch(const VoxelBox& voxels) {
  if (voxels.empty()) return;
  // The bricks of every cell that has one of the voxels for a corner: from the one below the first.
  const glm::ivec3 low = (voxels.first - 1 + kEdge) / kEdge, high = (voxels.first + voxels.extent - 1 + kEdge) / kEdge;
  for (int k = low.z; k <= high.z; ++k)
    for (int j = low.y; j <= high.y; ++j)
      for (int i = low.x; i <= high.x; ++i)
        if (std::uint8_t& touched = is_touched_[index({i, j, k})]; touched == 0) {
          touched = 1;
          touched_.push_back({i, j, k});
        }
}

void SolidCells::refresh() {
  bool is_fuller = false;
  for (const glm::ivec3& brick : touched_) {
    const std::size_t b = index(brick);
    is_touched_[b] = 0;
    const Block block = voxelsOf(*solid_, brick);
    const std::uint8_t eighths = solidEighths(block);
    const bool was = solid_eighths_[b] != 0, is = eighths != 0;
    if (is && slot_[b] < 0) {
      slot_[b] = static_cast<std::int32_t>(words_.size() / kBrickWords);
      words_.resize(words_.size() + kBrickWords);
    }
    if (slot_[b] >= 0) fill(block, wordsOf(slot_[b]));
    solid_eighths_[b] = eighths;
    is_fuller = is_fuller || (is && !was);
    is_stale_ = is_stale_ || is != was;
    // An emptied brick may be passed at once; how far beyond is seen when the distances are rebuilt.
    if (was) table_[b] = is ? slot_[b] * 256 + eighths : -1;
  }
  touched_.clear();
  if (is_fuller) rebuild();
}

void SolidCells::rebuildIfStale() {
  refresh();
  if (is_stale_) rebuild();
}

void SolidCells::rebuild() {
  is_stale_ = false;
  table_.resize(slot_.size());
  std::vector<std::uint8_t> away(table_.size());
  distancesInBricks(bricks_, solid_eighths_, kFarthest, away);
  for (std::size_t b = 0; b < table_.size(); ++b)
    table_[b] = solid_eighths_[b] != 0 ? slot_[b] * 256 + solid_eighths_[b] : -std::int32_t{away[b]};
}

}  // namespace render
