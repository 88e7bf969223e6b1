#include "assets/segment/label_changes.h"

#include <cassert>

#include "assets/volume_grid.h"

namespace assets {

namespace {

constexpr std::size_t kCells = std::size_t{LabelChanges::kBrick} * LabelChanges::kBrick * LabelChanges::kBrick;

glm::ivec3 bricksOf(const VolumeGrid& grid) { return (grid.size + LabelChanges::kBrick - 1) / LabelChanges::kBrick; }

}  // namespace

/// visit(number in the brick, ijk, voxel); cells beyond the grid have numbers too.
template <class Visit>
void LabelChanges::forCellsOf(const glm::ivec3& low, const Visit& visit) const {
  const glm::ivec3 end = glm::min(low + kBrick, grid_.size);
  forVoxels(low, end, [&](glm::ivec3 ijk) {
    const glm::ivec3 at = ijk - low;
    visit(static_cast<std::size_t>(at.x + kBrick * (at.y + kBrick * at.z)), ijk, grid_.index(ijk));
  });
}

void LabelChanges::keep(const JawSegmentation& jaw, const glm::ivec3& ijk) {
  const std::size_t brick = indexIn(bricksOf(grid_), ijk / kBrick);
  if (brick == last_) return;
  last_ = brick;
  const auto opened = open_.try_emplace(brick);
  if (!opened.second) return;
  auto& cells = opened.first->second;
  forCellsOf(kBrick * (ijk / kBrick), [&](std::size_t n, glm::ivec3, std::size_t v) {
    cells[n] = {jaw.label[v], jaw.tooth[v]};
  });
}

void LabelChanges::pack(const JawSegmentation& jaw) {
  for (const auto& open : open_) {
    OfBrick kept{kBrick * elementAt(bricksOf(grid_), open.first), {}};
    const auto& cells = open.second;
    std::size_t next = kCells;
    forCellsOf(kept.low, [&](std::size_t n, glm::ivec3, std::size_t v) {
      const VoxelLabel before = cells[n];
      if (before.label == jaw.label[v] && before.tooth == jaw.tooth[v]) return;
      Run* const run = kept.runs.empty() ? nullptr : &kept.runs.back();
      if (run != nullptr && n == next && run->label == before.label && run->tooth == before.tooth)
        ++run->count;
      else
        kept.runs.push_back({static_cast<std::uint16_t>(n), 1, before.label, before.tooth});
      next = n + 1;
    });
    kept.runs.shrink_to_fit();
    if (!kept.runs.empty()) runs_.push_back(std::move(kept));
  }
  open_.clear();
  last_ = static_cast<std::size_t>(-1);
}

void LabelChanges::takeBack(const JawSegmentation& jaw, const ChangeVoxel& change) const {
  assert(open_.empty());
  assert(jaw.label.size() == grid_.voxelCount());
  for (const OfBrick& brick : runs_)
    for (const Run& run : brick.runs)
      for (std::size_t n = run.first; n < std::size_t{run.first} + run.count; ++n) {
        const auto cell = static_cast<int>(n);
        const glm::ivec3 ijk = brick.low + glm::ivec3(cell % kBrick, cell / kBrick % kBrick, cell / (kBrick * kBrick));
        change(ijk, grid_.index(ijk), {run.label, run.tooth});
      }
}

std::size_t LabelChanges::bytes() const {
  std::size_t sum = sizeof *this + open_.size() * sizeof(Cells);
  for (const OfBrick& brick : runs_) sum += sizeof brick + brick.runs.capacity() * sizeof(Run);
  return sum;
}

}  // namespace assets
