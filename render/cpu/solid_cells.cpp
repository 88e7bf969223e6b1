#include "render/cpu/solid_cells.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cstring>

#include "assets/ct_volume.h"

namespace render {
namespace {

constexpr int kEdge = SolidCells::kEdge, kSide = kEdge + 1;

/// The voxels of a brick's cells, air outside the volume.
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

/// A bit for each eighth of the cells with a solid corner.
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
    : solid_(&solid),
      occupancy_((solid.layout().size + kEdge - 1) / kEdge + 2, kEdge,
                 [&solid](glm::ivec3 brick) { return solidEighths(voxelsOf(solid, brick)); }),
      slot_(occupancy_.marks().size(), -1) {
  std::int32_t kept = 0;
  for (std::size_t b = 0; b < slot_.size(); ++b)
    if (occupancy_.marks()[b] != 0) slot_[b] = kept++;
  words_.resize(static_cast<std::size_t>(kept) * kBrickWords);
  oneapi::tbb::parallel_for(0, bricks().z, [this](int k) {
    forEachIn({{0, 0, k}, {bricks().x, bricks().y, 1}}, [this](glm::ivec3 brick) {
      if (const std::int32_t slot = slot_[indexIn(bricks(), brick)]; slot >= 0)
        fill(voxelsOf(*solid_, brick), wordsOf(slot));
    });
  });
  writeTable();
}

// Cells extend one voxel upwards, and the table has a border of one brick.
void SolidCells::touch(const VoxelBox& voxels) { occupancy_.touch({voxels.first + kEdge, voxels.extent - 1}); }

void SolidCells::refresh() {
  const std::vector<glm::ivec3> touched = occupancy_.touched();
  const bool is_fuller = occupancy_.refresh();
  for (const glm::ivec3& brick : touched) {
    const std::size_t b = indexIn(bricks(), brick);
    const std::uint8_t eighths = occupancy_.marks()[b];
    if (eighths != 0 && slot_[b] < 0) {
      slot_[b] = static_cast<std::int32_t>(words_.size() / kBrickWords);
      words_.resize(words_.size() + kBrickWords);
    }
    if (slot_[b] >= 0) fill(voxelsOf(*solid_, brick), wordsOf(slot_[b]));
    // An emptied brick can be skipped now; its exact distance follows when the distances are rebuilt.
    table_[b] = eighths != 0 ? slot_[b] * 256 + eighths : std::min(table_[b], -1);
  }
  if (is_fuller) writeTable();
}

void SolidCells::rebuildIfStale() {
  refresh();
  if (occupancy_.rebuildIfStale()) writeTable();
}

void SolidCells::writeTable() {
  table_.resize(slot_.size());
  for (std::size_t b = 0; b < table_.size(); ++b)
    table_[b] =
        occupancy_.marks()[b] != 0 ? slot_[b] * 256 + occupancy_.marks()[b] : -std::int32_t{occupancy_.emptiness()[b]};
}

}  // namespace render
