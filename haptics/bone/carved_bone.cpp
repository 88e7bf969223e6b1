#include "haptics/bone/carved_bone.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <utility>

#include "calibration/random.h"
#include "haptics/bone/block_kernels.h"
#include "haptics/bone/stroke_history.h"

namespace haptics {
namespace {

constexpr double kHistoryShare = 0.42;        // of the blocks: 4 bytes a voxel in all
constexpr std::uint16_t kFullDose = 65535;    // all of a voxel's first content is gone
constexpr std::size_t kMinHistories = 16384;  // 4 MB: a small bone has a history for every block

std::size_t tissueOf(const SolidField& field, std::size_t place) {
  const std::size_t label = field.label == nullptr ? 0 : field.label[place];
  return label < assets::kTissueCount ? label : 0;
}

}  // namespace

CarvedBone::CarvedBone(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid,
                       std::span<const std::uint8_t> label, BlockStorage storage)
    : grid_(grid), cubelets_(grid, solid, label, storage), dirty_(grid.bricks()) {
  const SolidField at = field();
  const History uncut{};
  std::size_t with_bone = 0;
  for (std::size_t block = 0; block < blocks(); ++block) {
    const std::size_t slot = at.slotOf(block);
    if (at.weight[slot] == 0) continue;
    ++with_bone;
    solid_steps_ += at.weight[slot];
    addToDigest(calibration::mixedBits(block + 1),
                blockDigest(at.solid + slot * kBlockVoxels, uncut.reach.data(), uncut.dose.data()));
  }
  history_of_.assign(cubelets_.slots(), 0);
  written_.assign((blocks() + 63) / 64, 0);
  const auto share = static_cast<std::size_t>(kHistoryShare * static_cast<double>(blocks()));
  const std::size_t most = storage == BlockStorage::dense ? std::max(share, kMinHistories) : kMinHistories;
  histories_most_ = std::min(with_bone, most);
  histories_.resize(histories_most_);
}

void CarvedBone::addToDigest(std::uint64_t block_key, const BlockDigest& change) {
  const auto low = static_cast<std::uint32_t>(digest_) + (static_cast<std::uint32_t>(block_key) | 1u) * change.low;
  const auto high =
      static_cast<std::uint32_t>(digest_ >> 32) + (static_cast<std::uint32_t>(block_key >> 32) | 1u) * change.high;
  digest_ = static_cast<std::uint64_t>(high) << 32 | low;
}

CarvedBone::History* CarvedBone::historyOf(std::size_t block) {
  const SolidField at = field();
  const std::size_t slot = at.slotOf(block);
  if (history_of_[slot] == 0) {
    if (histories_used_ == histories_most_) return nullptr;
    History& fresh = histories_[histories_used_++];
    history_of_[slot] = static_cast<std::uint32_t>(histories_used_);
    const std::uint8_t* solid = at.solid + slot * kBlockVoxels;
    std::copy(solid, solid + kBlockVoxels, fresh.first.begin());
    fresh.reach.fill(0);
    fresh.dose.fill(0);
  }
  return &histories_[history_of_[slot] - 1];
}

bool CarvedBone::cutBlock(glm::ivec3 block_ijk, const BlockCut& cut,
                          std::array<std::int64_t, assets::kTissueCount>& steps, StrokeHistory* strokes) {
  const SolidField at = field();
  const std::size_t block = at.blockAt(block_ijk);
  if (!meetsBlock(at.solid + at.slotOf(block) * kBlockVoxels, cut.coverage.data())) return false;
  if (!cubelets_.own(block)) return cutWhole(block_ijk, cut, steps, strokes);
  const std::size_t slot = at.slotOf(block), start = slot * kBlockVoxels;
  const std::uint8_t* const before = at.solid + start;
  const std::uint64_t key = calibration::mixedBits(block + 1);
  const bool mixed_labels = at.only_label[slot] == kMixedLabels;
  const std::size_t only_tissue = tissueOf(at, start);
  saveTo(strokes, block);
  markWritten(block);

  alignas(64) std::array<std::uint32_t, kBlockVoxels> loss_q32;
  alignas(64) std::array<std::uint8_t, kBlockVoxels> after;
  for (std::size_t n = 0; n < kBlockVoxels; ++n)
    loss_q32[n] = cut.loss_q32[mixed_labels ? tissueOf(at, start + n) : only_tissue];

  History* const history = historyOf(block);
  BlockStep step{before,
                 cut.coverage.data(),
                 cut.exposure.data(),
                 loss_q32.data(),
                 history == nullptr ? nullptr : history->first.data(),
                 history == nullptr ? nullptr : history->reach.data(),
                 history == nullptr ? nullptr : history->dose.data(),
                 static_cast<std::uint32_t>(key >> 32),
                 static_cast<std::uint32_t>(cut.tick) * 0x9E3779B9u,  // 2^32 over the golden ratio
                 after.data(),
                 {0, 0},
                 0};
  stepBlock(step);
  addToDigest(key, step.digest_change);
  if (step.removed == 0) return false;
  if (mixed_labels) {
    for (std::size_t n = 0; n < kBlockVoxels; ++n) {
      const std::size_t tissue = tissueOf(at, start + n);
      steps[tissue] += before[n] - after[n];
      removed_steps_[tissue] += before[n] - after[n];
    }
  } else {
    steps[only_tissue] += step.removed;
    removed_steps_[only_tissue] += step.removed;
  }
  solid_steps_ -= step.removed;
  cubelets_.setBlock(block, after);
  dirty_.mark(block_ijk * kBlockEdge / assets::kBrickVoxels);
  return true;
}

bool CarvedBone::meetsGiven(std::size_t block, std::span<const std::uint8_t, kBlockVoxels> given) const {
  const SolidField at = field();
  const std::uint8_t* const solid = at.solid + at.slotOf(block) * kBlockVoxels;
  bool meets = false;
  for (std::size_t n = 0; n < kBlockVoxels; ++n) meets = meets || (solid[n] != 0 && given[n] != 0);
  return meets;
}

/// Without a slot of its own an even block goes whole, in a tick that comes as often as its loss is large.
bool CarvedBone::cutWhole(glm::ivec3 block_ijk, const BlockCut& cut,
                          std::array<std::int64_t, assets::kTissueCount>& steps, StrokeHistory* strokes) {
  const SolidField at = field();
  const std::size_t block = at.blockAt(block_ijk), start = at.slotOf(block) * kBlockVoxels,
                    tissue = tissueOf(at, start);
  std::uint64_t covered = 0, exposed = 0;
  for (std::size_t n = 0; n < kBlockVoxels; ++n) covered += cut.coverage[n], exposed += cut.exposure[n];
  if (2 * covered < std::uint64_t{kFullDose} * kBlockVoxels) return false;
  const std::uint64_t loss = exposed * cut.loss_q32[tissue] / covered;  // as if it were covered whole
  const std::uint32_t due = static_cast<std::uint32_t>(calibration::mixedBits(block + 1) >> 32) +
                            static_cast<std::uint32_t>(cut.tick) * 0x9E3779B9u;
  if (due >= loss) return false;
  __atomic_store_n(&cuts_whole_, true, __ATOMIC_RELAXED);
  saveTo(strokes, block);
  const std::int64_t lost = -restoreBlock(block, {});
  steps[tissue] += lost;
  return lost != 0;
}

void CarvedBone::saveTo(StrokeHistory* strokes, std::size_t block) const {
  if (strokes != nullptr && strokes->needsSaving(first_block_ + block))
    strokes->save(first_block_ + block, stateOf(block));
}

CarvedBone CarvedBone::emptied(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid,
                               std::span<const std::uint8_t> label) {
  CarvedBone empty(grid, solid, label, BlockStorage::dense);
  const SolidField at = empty.field();
  for (std::size_t block = 0; block < empty.blocks(); ++block) {
    if (at.weight[at.slotOf(block)] == 0) continue;
    BlockState gone;
    if (empty.historyOf(block) != nullptr) gone.dose.fill(kFullDose);
    empty.restoreBlock(block, gone);
  }
  empty.removed_steps_ = {};
  std::vector<glm::ivec3> unchanged;
  empty.dirty_.takeInto(unchanged);
  return empty;
}

void CarvedBone::moveBlock(std::size_t block, std::span<const std::uint8_t, kBlockVoxels> given, CarvedBone& to,
                           StrokeHistory* strokes) {
  if (!meetsGiven(block, given) || !cubelets_.own(block) || !to.cubelets_.own(block)) return;
  BlockState from_state = stateOf(block), to_state = to.stateOf(block);
  const History* const history = historyOf(block);
  const std::uint32_t to_history = to.history_of_[to.field().slotOf(block)];
  const auto key = static_cast<std::uint32_t>(calibration::mixedBits(block + 1) >> 32);
  for (std::size_t n = 0; n < kBlockVoxels; ++n) {
    const std::uint8_t whole = from_state.solid[n], moved = std::min(given[n], whole);
    if (moved == 0) continue;
    const auto received = static_cast<std::uint8_t>(std::min(255, to_state.solid[n] + moved));
    if (to_history != 0) {
      const std::uint8_t first = to.histories_[to_history - 1].first[n];
      const bool is_all = received == whole && history != nullptr && first == history->first[n];
      to_state.dose[n] = is_all ? from_state.dose[n] : doseLeaving(first, received, key, static_cast<std::uint32_t>(n));
      to_state.reach[n] = std::max(to_state.reach[n], from_state.reach[n]);
    }
    to_state.solid[n] = received;
    from_state.solid[n] = static_cast<std::uint8_t>(whole - moved);
    if (history != nullptr)
      from_state.dose[n] = doseLeaving(history->first[n], from_state.solid[n], key, static_cast<std::uint32_t>(n));
  }
  saveTo(strokes, block);
  to.saveTo(strokes, block);
  restoreBlock(block, from_state);
  to.restoreBlock(block, to_state);
}

std::int64_t CarvedBone::loseBlock(std::size_t block, std::span<const std::uint8_t, kBlockVoxels> given,
                                   StrokeHistory* strokes) {
  if (!meetsGiven(block, given) || !cubelets_.own(block)) return 0;
  BlockState state = stateOf(block);
  const History* const history = historyOf(block);
  const auto key = static_cast<std::uint32_t>(calibration::mixedBits(block + 1) >> 32);
  for (std::size_t n = 0; n < kBlockVoxels; ++n) {
    const std::uint8_t taken = std::min(given[n], state.solid[n]);
    if (taken == 0) continue;
    state.solid[n] = static_cast<std::uint8_t>(state.solid[n] - taken);
    if (history != nullptr)
      state.dose[n] = doseLeaving(history->first[n], state.solid[n], key, static_cast<std::uint32_t>(n));
  }
  saveTo(strokes, block);
  return -restoreBlock(block, state);
}

BlockState CarvedBone::stateOf(std::size_t block) const {
  BlockState state;
  const SolidField at = field();
  const std::size_t slot = at.slotOf(block);
  const std::uint8_t* const solid = at.solid + slot * kBlockVoxels;
  std::copy(solid, solid + kBlockVoxels, state.solid.begin());
  if (history_of_[slot] != 0) {
    const History& history = histories_[history_of_[slot] - 1];
    state.reach = history.reach;
    state.dose = history.dose;
  }
  return state;
}

std::int64_t CarvedBone::restoreBlock(std::size_t block, const BlockState& state) {
  const BlockState now = stateOf(block);
  // Only a part of a block without a slot of its own cannot come or go where none is left.
  if (state.solid != now.solid && !cubelets_.setBlock(block, state.solid)) return 0;
  markWritten(block);
  const BlockDigest from = blockDigest(now.solid.data(), now.reach.data(), now.dose.data());
  const BlockDigest to = blockDigest(state.solid.data(), state.reach.data(), state.dose.data());
  addToDigest(calibration::mixedBits(block + 1), {to.low - from.low, to.high - from.high});
  const SolidField at = field();
  const std::size_t slot = at.slotOf(block), start = slot * kBlockVoxels;
  // A history that began later began with the restored content: `first` stays valid.
  if (history_of_[slot] != 0) {
    History& history = histories_[history_of_[slot] - 1];
    history.reach = state.reach;
    history.dose = state.dose;
  }
  if (state.solid == now.solid) return 0;

  std::int64_t steps = 0;
  for (std::size_t n = 0; n < kBlockVoxels; ++n) {
    const int more = state.solid[n] - now.solid[n];
    removed_steps_[tissueOf(at, start + n)] -= more;
    steps += more;
  }
  solid_steps_ += steps;
  const int at_x = static_cast<int>(block % static_cast<std::size_t>(at.blocks.x));
  const auto rows = static_cast<int>(block / static_cast<std::size_t>(at.blocks.x));
  dirty_.mark(glm::ivec3(at_x, rows % at.blocks.y, rows / at.blocks.y) * kBlockEdge / assets::kBrickVoxels);
  return steps;
}

void CarvedBone::takeWritten(std::vector<std::size_t>& out) {
  for (std::size_t word = 0; word < written_.size(); ++word)
    for (std::uint64_t bits = std::exchange(written_[word], 0); bits != 0; bits &= bits - 1)
      out.push_back(64 * word + static_cast<std::size_t>(std::countr_zero(bits)));
}

std::array<double, assets::kTissueCount> CarvedBone::removedByTissue_mm3() const noexcept {
  std::array<double, assets::kTissueCount> removed_mm3{};
  for (std::size_t tissue = 0; tissue < removed_mm3.size(); ++tissue)
    removed_mm3[tissue] = static_cast<double>(removed_steps_[tissue]) * grid_.voxelVolume_mm3() / 255.0;
  return removed_mm3;
}

std::vector<std::uint8_t> CarvedBone::solidInGridOrder() const {
  const SolidField at = field();
  std::vector<std::uint8_t> solid(grid_.voxelCount());
  std::size_t out = 0;
  for (int k = 0; k < grid_.size.z; ++k)
    for (int j = 0; j < grid_.size.y; ++j)
      for (int i = 0; i < grid_.size.x; ++i) solid[out++] = at.solidAt({i, j, k});
  return solid;
}

std::vector<std::uint8_t> CarvedBone::labelInGridOrder() const {
  const SolidField at = field();
  if (at.label == nullptr) return {};
  std::vector<std::uint8_t> label(grid_.voxelCount());
  assets::forVoxels(grid_, [&](glm::ivec3 ijk, std::size_t v) {
    const std::size_t slot = cubelets_.slotSeen(at.blockAt(SolidField::blockOf(ijk)));
    label[v] = at.label[slot * kBlockVoxels + SolidField::within(ijk)];
  });
  return label;
}

void CarvedBone::copyBrick(glm::ivec3 brick, std::span<std::uint8_t, 512> solid_out) const {
  const SolidField at = field();
  const glm::ivec3 corner = brick * assets::kBrickVoxels;
  std::size_t out = 0;
  for (int k = 0; k < assets::kBrickVoxels; ++k)
    for (int j = 0; j < assets::kBrickVoxels; ++j)
      for (int i = 0; i < assets::kBrickVoxels; ++i, ++out) {
        const glm::ivec3 ijk = corner + glm::ivec3(i, j, k);
        if (!grid_.contains(ijk)) {
          solid_out[out] = 0;
          continue;
        }
        const std::size_t slot = cubelets_.slotSeen(at.blockAt(SolidField::blockOf(ijk)));
        // The atomic view needs a mutable reference; nothing is written through it.
        auto& byte = const_cast<std::uint8_t&>(at.solid[slot * kBlockVoxels + SolidField::within(ijk)]);
        solid_out[out] = std::atomic_ref<std::uint8_t>(byte).load(std::memory_order_relaxed);
      }
}

std::vector<std::uint8_t> CarvedBone::copyBox(glm::ivec3 first_brick, glm::ivec3 size) const {
  std::vector<std::uint8_t> solid(assets::countIn(size));
  std::array<std::uint8_t, 512> part{};
  const glm::ivec3 bricks = (size + assets::kBrickVoxels - 1) / assets::kBrickVoxels;
  assets::forVoxels(glm::ivec3(0), bricks, [&](glm::ivec3 brick) {
    copyBrick(first_brick + brick, part);
    const glm::ivec3 corner = brick * assets::kBrickVoxels;
    assets::forVoxels(corner, glm::min(corner + assets::kBrickVoxels, size), [&](glm::ivec3 at) {
      solid[assets::indexIn(size, at)] = part[assets::indexIn(glm::ivec3(assets::kBrickVoxels), at - corner)];
    });
  });
  return solid;
}

std::size_t CarvedBone::bytes() const {
  return cubelets_.bytes() + history_of_.size() * sizeof(std::uint32_t) + histories_most_ * sizeof(History);
}

}  // namespace haptics
