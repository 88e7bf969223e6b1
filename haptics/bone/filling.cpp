#include "haptics/bone/filling.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "calibration/random.h"
#include "haptics/bone/block_kernels.h"
#include "haptics/bone/stroke_history.h"

namespace haptics {
namespace {

constexpr std::uint32_t kWhole = 65535;  // of a coverage

bool isNothing(const BlockState& state) {
  return std::all_of(state.solid.begin(), state.solid.end(), [](std::uint8_t one) { return one == 0; });
}

/// As the field shows them: where a block holds nothing, what lies beside, so that most blocks have one label.
std::array<std::uint8_t, kBlockVoxels> labelsOf(const BlockState& state) {
  std::array<std::uint8_t, kBlockVoxels> label = state.reach;
  const auto some = std::find_if(label.begin(), label.end(), [](std::uint8_t one) { return one != 0; });
  if (some == label.end()) return label;
  const std::uint8_t first = *some;
  for (std::uint8_t& one : label)
    if (one == 0) one = first;
  return label;
}

}  // namespace

Filling::Filling(const assets::VolumeGrid& grid)
    : grid_(grid), cubelets_(grid, kMostBlocks), set_(grid, kMostBlocks), dirty_(grid.bricks()) {
  mark_.assign(cubelets_.slots() * kBlockVoxels, 0);
  written_.assign((blocks() + 63) / 64, 0);
}

void Filling::begin(const Volumes& volumes) {
  const auto least = [](unsigned value, unsigned most) { return std::min(value, most); };
  bool is_open = true;
  const glm::ivec3 blocks_ijk = field().blocks;
  assets::forVoxels(glm::ivec3(0), blocks_ijk, [&](glm::ivec3 block) {
    BlockState state;
    const glm::ivec3 first = block * kBlockEdge;
    assets::forVoxels(first, glm::min(first + kBlockEdge, grid_.size), [&](glm::ivec3 ijk) {
      const std::size_t v = grid_.index(ijk), n = SolidField::within(ijk);
      if (volumes.laid[v] == 0) return;
      state.solid[n] = volumes.laid[v], state.reach[n] = volumes.tissue[v];
      const unsigned increment = least(volumes.increment[v], kMostIncrements);
      const unsigned light = volumes.light.empty() ? 0U : least(volumes.light[v], kMostLight);
      state.dose[n] = static_cast<std::uint16_t>(increment << kIncrementShift | light);
      if (increment < begun_.increment) return;
      const auto tissue = static_cast<assets::Tissue>(state.reach[n]);
      // What light sets may be gone on with until some of it has set.
      const bool waits = settingOf(state.reach[n]).light_s > 0.0;
      is_open = waits && (increment > begun_.increment || (is_open && tissue == begun_.material));
      begun_.increment = increment, begun_.material = tissue;
    });
    if (!isNothing(state)) restoreBlock(field().blockAt(block), state);
  });
  if (!is_open) begun_.material = assets::Tissue::unlabelled;
  const std::size_t ages = std::min<std::size_t>(volumes.age_s.size(), kMostIncrements);
  for (std::size_t n = 0; n < ages; ++n) begun_.age_s[n + 1] = volumes.age_s[n];
}

BlockState Filling::stateOf(std::size_t block) const {
  BlockState state;
  if (!cubelets_.isOwn(block)) return state;
  const SolidField at = field();
  const std::size_t start = at.slotOf(block) * kBlockVoxels;
  std::copy_n(at.solid + start, kBlockVoxels, state.solid.begin());
  std::copy_n(mark_.begin() + static_cast<std::ptrdiff_t>(start), kBlockVoxels, state.dose.begin());
  for (std::size_t n = 0; n < kBlockVoxels; ++n)
    if (state.solid[n] != 0) state.reach[n] = at.label[start + n];
  return state;
}

void Filling::restoreBlock(std::size_t block, const BlockState& state) {
  const BlockState now = stateOf(block);
  if (now == state || !cubelets_.own(block)) return;
  cubelets_.setLabels(block, labelsOf(state));
  cubelets_.setBlock(block, state.solid);
  setSetPart(block, state);
  const SolidField at = field();
  std::uint16_t* const mark = mark_.data() + at.slotOf(block) * kBlockVoxels;
  for (std::size_t n = 0; n < kBlockVoxels; ++n) __atomic_store_n(mark + n, state.dose[n], __ATOMIC_RELAXED);
  for (std::size_t n = 0; n < kBlockVoxels; ++n) {
    steps_of_[now.reach[n]] -= now.solid[n];
    steps_of_[state.reach[n]] += state.solid[n];
    steps_ += state.solid[n] - now.solid[n];
  }
  const std::uint64_t key = calibration::mixedBits(block + 1);
  const BlockDigest from = blockDigest(now.solid.data(), now.reach.data(), now.dose.data());
  const BlockDigest to = blockDigest(state.solid.data(), state.reach.data(), state.dose.data());
  const auto low = static_cast<std::uint32_t>(digest_) + (static_cast<std::uint32_t>(key) | 1U) * (to.low - from.low);
  const auto high =
      static_cast<std::uint32_t>(digest_ >> 32) + (static_cast<std::uint32_t>(key >> 32) | 1U) * (to.high - from.high);
  digest_ = static_cast<std::uint64_t>(high) << 32 | low;
  written_[block / 64] |= std::uint64_t{1} << block % 64;
  if (state.solid == now.solid && state.reach == now.reach) return;
  const int at_x = static_cast<int>(block % static_cast<std::size_t>(at.blocks.x));
  const auto rows = static_cast<int>(block / static_cast<std::size_t>(at.blocks.x));
  dirty_.mark(glm::ivec3(at_x, rows % at.blocks.y, rows / at.blocks.y) * kBlockEdge / assets::kBrickVoxels);
}

void Filling::setSetPart(std::size_t block, const BlockState& state) {
  BlockState part;
  bool is_some = set_.isOwn(block);
  for (std::size_t n = 0; n < kBlockVoxels; ++n) {
    if (state.solid[n] == 0 || isPlastic(state.reach[n])) continue;
    part.solid[n] = state.solid[n], part.reach[n] = state.reach[n];
    is_some = true;
  }
  // There are as many slots as for the whole.
  if (!is_some || !set_.own(block)) return;
  const SolidField at = set_.field();
  set_steps_ -= at.weight[at.slotOf(block)];
  set_.setLabels(block, labelsOf(part));
  set_.setBlock(block, part.solid);
  set_steps_ += at.weight[at.slotOf(block)];
}

bool Filling::setBlock(std::size_t block, const BlockState& state, StrokeHistory* strokes) {
  if (!cubelets_.isOwn(block) && (isNothing(state) || !cubelets_.own(block))) return false;
  if (strokes != nullptr && strokes->needsSaving(first_block_ + block))
    strokes->save(first_block_ + block, stateOf(block));
  restoreBlock(block, state);
  return true;
}

bool Filling::cutBlock(glm::ivec3 block_ijk, const BlockCut& cut, std::array<std::int64_t, assets::kTissueCount>& steps,
                       StrokeHistory* strokes) {
  const std::size_t block = field().blockAt(block_ijk);
  BlockState state = stateOf(block);
  const auto key = static_cast<std::uint32_t>(calibration::mixedBits(block + 1) >> 32);
  bool takes = false;
  for (std::size_t n = 0; n < kBlockVoxels; ++n) {
    const std::uint32_t laid = state.solid[n], beside = (kWhole - cut.coverage[n]) * 255U / kWhole;
    if (laid <= beside) continue;
    // Golden-ratio steps from a start of each voxel, as bone rounds.
    const std::uint32_t start = static_cast<std::uint32_t>(calibration::mixedBits(key + n)) +
                                static_cast<std::uint32_t>(cut.tick) * 0x9E3779B9U;
    const std::uint64_t asked = std::min<std::uint64_t>(cut.exposure[n], kWhole) * 255U * cut.loss_q32[state.reach[n]];
    const auto less = static_cast<std::uint32_t>(((asked / kWhole) + start) >> 32);
    const std::uint32_t taken = std::min(less, laid - beside);
    if (taken == 0) continue;
    takes = true;
    steps[state.reach[n]] += taken;
    state.solid[n] = static_cast<std::uint8_t>(laid - taken);
    if (state.solid[n] == 0) state.reach[n] = 0, state.dose[n] = 0;
  }
  return takes && setBlock(block, state, strokes);
}

double Filling::volume_mm3(assets::Tissue material) const {
  return static_cast<double>(steps_of_[static_cast<std::size_t>(material)]) * grid_.voxelVolume_mm3() / 255.0;
}

void Filling::takeWritten(std::vector<std::size_t>& out) {
  for (std::size_t word = 0; word < written_.size(); ++word)
    for (std::uint64_t bits = std::exchange(written_[word], 0); bits != 0; bits &= bits - 1)
      out.push_back(64 * word + static_cast<std::size_t>(std::countr_zero(bits)));
}

FillingBrick Filling::copyBrick(glm::ivec3 brick) const {
  const SolidField at = field();
  const glm::ivec3 corner = brick * assets::kBrickVoxels;
  FillingBrick copy;
  std::size_t out = 0;
  assets::forVoxels(corner, corner + assets::kBrickVoxels, [&](glm::ivec3 ijk) {
    const std::size_t here = out++;
    if (!grid_.contains(ijk)) return;
    const std::size_t slot = cubelets_.slotSeen(at.blockAt(SolidField::blockOf(ijk)));
    const std::size_t place = slot * kBlockVoxels + SolidField::within(ijk);
    copy.laid[here] = __atomic_load_n(at.solid + place, __ATOMIC_RELAXED);
    if (copy.laid[here] == 0) return;
    copy.tissue[here] = __atomic_load_n(at.label + place, __ATOMIC_RELAXED);
    copy.increment[here] =
        static_cast<std::uint8_t>(__atomic_load_n(mark_.data() + place, __ATOMIC_RELAXED) >> kIncrementShift);
  });
  return copy;
}

Filling::Volumes Filling::volumes() const {
  const SolidField at = field();
  const std::size_t count = grid_.voxelCount();
  Volumes volumes{
      std::vector<std::uint8_t>(count), std::vector<std::uint8_t>(count), std::vector<std::uint8_t>(count), {}, {}};
  assets::forVoxels(glm::ivec3(0), at.blocks, [&](glm::ivec3 block) {
    const std::size_t number = at.blockAt(block);
    if (at.weight[at.slotOf(number)] == 0) return;
    const BlockState state = stateOf(number);
    const glm::ivec3 first = block * kBlockEdge;
    assets::forVoxels(first, glm::min(first + kBlockEdge, grid_.size), [&](glm::ivec3 ijk) {
      const std::size_t n = SolidField::within(ijk), v = grid_.index(ijk);
      volumes.laid[v] = state.solid[n];
      volumes.tissue[v] = state.reach[n];
      volumes.increment[v] = static_cast<std::uint8_t>(state.dose[n] >> kIncrementShift);
      const auto light = static_cast<std::uint16_t>(state.dose[n] & kMostLight);
      if (light == 0) return;
      if (volumes.light.empty()) volumes.light.resize(count);
      volumes.light[v] = light;
    });
  });
  return volumes;
}

}  // namespace haptics
