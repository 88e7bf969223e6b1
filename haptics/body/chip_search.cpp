#include "haptics/body/chip_search.h"

#include <algorithm>
#include <bit>
#include <map>
#include <set>
#include <utility>

#include "assets/ct_volume.h"
#include "calibration/random.h"
#include "haptics/body/piece_split.h"

namespace haptics {
namespace {

/// Masks by brick of what belongs to a component that is no chip.
std::vector<BrickMask> wholeOf(const Components& components) {
  std::vector<BrickMask> whole(assets::countIn(components.bricks()));
  for (std::size_t brick = 0; brick < whole.size(); ++brick) {
    const std::span<const BrickPart> parts = components.partsIn(brick);
    for (std::size_t n = 0; n < parts.size(); ++n) {
      if (components.pieces()[components.pieceOf(brick, n)].volume_mm3 < kLeastPiece_mm3) continue;
      for (std::size_t k = 0; k < whole[brick].size(); ++k) whole[brick][k] |= parts[n].mask[k];
    }
  }
  return whole;
}

template <class Visit>
void forVoxelsOf(const BrickMask& mask, glm::ivec3 corner, const Visit& visit) {
  for (int k = 0; k < assets::kBrickVoxels; ++k)
    for (std::uint64_t left = mask[static_cast<std::size_t>(k)]; left != 0; left &= left - 1) {
      const int at = std::countr_zero(left);
      visit(corner + glm::ivec3(at % assets::kBrickVoxels, at / assets::kBrickVoxels, k));
    }
}

/// The voxels of each small component, by its number, that was part of something larger.
std::map<std::size_t, std::vector<glm::ivec3>> smallComponents(const Components& now,
                                                               const std::vector<BrickMask>& whole) {
  std::map<std::size_t, std::vector<glm::ivec3>> small;
  std::set<std::size_t> came_off;
  forBricks(now.bricks(), [&](std::size_t brick, glm::ivec3 corner) {
    const std::span<const BrickPart> parts = now.partsIn(brick);
    for (std::size_t n = 0; n < parts.size(); ++n) {
      const std::size_t piece = now.pieceOf(brick, n);
      if (now.pieces()[piece].volume_mm3 >= kLeastPiece_mm3) continue;
      for (std::size_t k = 0; k < whole[brick].size(); ++k)
        if ((parts[n].mask[k] & whole[brick][k]) != 0) came_off.insert(piece);
      forVoxelsOf(parts[n].mask, corner, [&](glm::ivec3 ijk) { small[piece].push_back(ijk); });
    }
  });
  std::erase_if(small, [&](const auto& one) { return !came_off.contains(one.first); });
  return small;
}

SolidField latticeOf(const assets::VolumeGrid& grid) {
  SolidField lattice;
  lattice.blocks = (grid.size + kBlockEdge - 1) / kBlockEdge;
  return lattice;
}

/// A chip's own voxels, and those of less than half beside it that go with it.
std::map<std::size_t, std::pair<glm::ivec3, std::uint8_t>> bytesOfChip(const Components& now,
                                                                       const std::vector<glm::ivec3>& voxels) {
  const assets::VolumeGrid& grid = now.grid();
  std::set<std::size_t> own;
  for (const glm::ivec3& ijk : voxels) own.insert(grid.index(ijk));
  const auto is_own = [&](glm::ivec3 ijk) { return own.contains(grid.index(ijk)); };
  std::map<std::size_t, std::pair<glm::ivec3, std::uint8_t>> bytes;
  for (const glm::ivec3& ijk : voxels)
    assets::forVoxels(ijk - 1, ijk + 2, [&](glm::ivec3 at) {
      const std::uint8_t solid = now.solidAt(at);
      if (solid == 0) return;
      const bool goes = solid >= assets::kHalfSolid ? is_own(at) : followsChosen(now, at, is_own);
      if (goes) bytes.try_emplace(grid.index(at), at, solid);
    });
  return bytes;
}

std::uint64_t digestOf(const ChipPlan& plan) {
  std::uint64_t digest = plan.chips.size();
  const auto mix = [&](std::uint64_t bits) { digest = calibration::mixedBits(digest ^ bits); };
  for (const SplitPlan& taken : plan.taken) {
    mix(taken.blocks.size());
    for (const SplitPlan::Block& block : taken.blocks) {
      mix(block.block);
      for (const std::uint8_t given : block.given) mix(given);
    }
  }
  return digest;
}

}  // namespace

FirstBytes::FirstBytes(const Bodies& bodies)
    : grid(bodies.grid()), jaw(bodies.jaw().copyBox(glm::ivec3(0), grid.size)), first_brick(bodies.firstBrick()) {
  if (bodies.bones().size() < 2) return;
  piece_grid = bodies.bones()[1].grid();
  // In one piece or in several: what they are together.
  tooth.assign(piece_grid.voxelCount(), 0);
  for (const CarvedBone& piece : bodies.bones().subspan(1)) {
    const std::vector<std::uint8_t> part = piece.copyBox(glm::ivec3(0), piece_grid.size);
    for (std::size_t v = 0; v < tooth.size(); ++v)
      tooth[v] = static_cast<std::uint8_t>(std::min(255, tooth[v] + part[v]));
  }
}

ChipSearch::ChipSearch(const FirstBytes& first) {
  now_.reserve(kMaxBodies);
  now_.emplace_back(first.grid, first.jaw);
  whole_[0] = wholeOf(now_[0]);
  if (first.tooth.empty()) return;
  now_.emplace_back(first.piece_grid, first.tooth);
  whole_[1] = wholeOf(now_[1]);
  while (now_.size() < kMaxBodies) now_.emplace_back(first.piece_grid);
}

void ChipSearch::addChips(std::size_t bone, ChipPlan& plan) {
  Components& now = now_[bone];
  now.join();
  const SolidField lattice = latticeOf(now.grid());
  std::map<std::size_t, SplitPlan::Block> blocks;
  for (const auto& [piece, voxels] : smallComponents(now, whole_[std::min<std::size_t>(bone, 1)])) {
    if (plan.chips.size() == kMostChips) break;
    Chip chip{bone, 0, 0.0, now.pieces()[piece].centroid_mm, voxels.front()};
    for (const auto& [v, voxel] : bytesOfChip(now, voxels)) {
      const std::size_t number = lattice.blockAt(SolidField::blockOf(voxel.first));
      SplitPlan::Block& block = blocks[number];
      block.block = static_cast<std::uint32_t>(number);
      // A film between two chips goes with the first.
      if (std::exchange(block.given[SolidField::within(voxel.first)], voxel.second) == 0) chip.bytes += voxel.second;
    }
    chip.volume_mm3 = chip.bytes * now.grid().voxelVolume_mm3() / 255.0;
    plan.chips.push_back(chip);
  }
  for (const auto& [number, block] : blocks) plan.taken[bone].blocks.push_back(block);
}

ChipPlan ChipSearch::plan() {
  ChipPlan plan;
  for (std::size_t bone = 0; bone < now_.size(); ++bone) addChips(bone, plan);
  plan.digest = digestOf(plan);
  return plan;
}

void giveBrick(const Bodies& bodies, glm::ivec3 brick, ChipSearch& search) {
  ChipSearch::Brick bytes{};
  bodies.jaw().copyBrick(brick, bytes);
  search.update(0, brick, bytes);
  const auto own = bodies.brickOfPiece(brick);
  if (!own) return;
  for (std::size_t bone = 1; bone < bodies.bones().size(); ++bone) {
    bodies.bones()[bone].copyBrick(*own, bytes);
    search.update(bone, *own, bytes);
  }
}

}  // namespace haptics
