#include "assets/import/density_tissue.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "assets/segment/cell_masks.h"

namespace assets {
namespace {

constexpr double kMostPartial = 0.002;  ///< of a file of levels alone
constexpr auto kPulp = static_cast<std::uint8_t>(Tissue::pulp);
constexpr std::array<Tissue, 4> kOfLevel{Tissue::unlabelled, Tissue::pulp, Tissue::dentine, Tissue::enamel};

class Densities {
 public:
  Densities(const VolumeGrid& grid, std::span<const std::uint8_t> density, const ToothLevels& levels)
      : grid_(grid), density_(density), levels_(levels) {
    std::size_t matter = 0, partial = 0;
    for (const std::uint8_t value : density_) {
      if (isAir(value)) continue;
      ++matter;
      if (!levelOf(value)) ++partial;
    }
    is_plain_ = static_cast<double>(partial) <= kMostPartial * static_cast<double>(matter);
  }

  bool isAir(std::uint8_t value) const { return value <= levels_[0] + kOnLevel; }
  bool isPlain() const { return is_plain_; }

  /// Which of pulp, dentine and enamel, 1 to 3.
  std::size_t levelAt(std::size_t v) const {
    const std::uint8_t value = density_[v];
    if (is_plain_) return nearest(value);
    std::uint8_t most = value;
    bool beside_air = false;
    forBeside(v, [&](std::size_t beside) {
      beside_air = beside_air || isAir(density_[beside]);
      most = std::max(most, density_[beside]);
    });
    // Of a transition that is two voxels wide the inner one has no air beside it.
    if (beside_air || (!levelOf(value) && isNearAir(v))) return nearest(most);
    return nearest(value);
  }

  /// Share of the voxel that is solid, where the tissue is known.
  double solidAt(std::size_t v, std::size_t level) const {
    const double value = density_[v];
    if (level == 1) return 0.0;
    const double full = levels_[level], pulp = levels_[1];
    bool beside_air = false;
    forBeside(v, [&](std::size_t beside) { beside_air = beside_air || isAir(density_[beside]); });
    if (beside_air || (!levelOf(density_[v]) && isNearAir(v)))
      return std::clamp((value - levels_[0]) / (full - levels_[0]), 0.0, 1.0);
    // Towards the pulp.
    return level == 2 ? std::clamp((value - pulp) / (full - pulp), 0.0, 1.0) : 1.0;
  }

 private:
  /// None: between levels.
  bool levelOf(std::uint8_t value) const {
    return std::ranges::any_of(levels_, [&](int level) { return std::abs(value - level) <= kOnLevel; });
  }
  std::size_t nearest(std::uint8_t value) const {
    if (2 * value < levels_[1] + levels_[2]) return 1;
    return 2 * value < levels_[2] + levels_[3] ? 2 : 3;
  }
  template <class Visit>
  void forBeside(std::size_t v, const Visit& visit) const {
    const glm::ivec3 at = elementAt(grid_.size, v);
    forVoxels(glm::max(at - 1, glm::ivec3(0)), glm::min(at + 2, grid_.size),
              [&](glm::ivec3 ijk) { visit(grid_.index(ijk)); });
  }
  bool isNearAir(std::size_t v) const {
    const glm::ivec3 at = elementAt(grid_.size, v);
    bool is_near = false;
    forVoxels(glm::max(at - 2, glm::ivec3(0)), glm::min(at + 3, grid_.size),
              [&](glm::ivec3 ijk) { is_near = is_near || isAir(density_[grid_.index(ijk)]); });
    return is_near;
  }

  const VolumeGrid& grid_;
  std::span<const std::uint8_t> density_;
  const ToothLevels& levels_;
  bool is_plain_ = false;
};

/// What hangs together face to face and is the most; the others become 0. Returns its share of all.
double keepLargest(const VolumeGrid& grid, std::vector<std::uint8_t>& label) {
  const CellMask largest = largestPiece(grid.size, label);
  const auto count = [](const std::vector<std::uint8_t>& cells) {
    return static_cast<double>(cells.size()) - static_cast<double>(std::ranges::count(cells, std::uint8_t{0}));
  };
  const double all = count(label);
  for (std::size_t v = 0; v < label.size(); ++v)
    if (largest[v] == 0) label[v] = 0;
  return all == 0.0 ? 0.0 : count(largest) / all;
}

/// A quarter, a half and a quarter along each axis.
void drawOverThree(const VolumeGrid& grid, std::vector<float>& share) {
  const std::array<std::size_t, 3> step{1, static_cast<std::size_t>(grid.size.x),
                                        static_cast<std::size_t>(grid.size.x) * static_cast<std::size_t>(grid.size.y)};
  for (const std::size_t way : step) {
    std::vector<float> drawn = share;
    for (std::size_t v = way; v + way < share.size(); ++v)
      drawn[v] = 0.25f * share[v - way] + 0.5f * share[v] + 0.25f * share[v + way];
    share = std::move(drawn);
  }
}

}  // namespace

DensityTissue densityTissue(const VolumeGrid& grid, std::span<const std::uint8_t> density, const ToothLevels& levels) {
  const Densities densities(grid, density, levels);
  DensityTissue tissue;
  std::vector<float> share(density.size());
  tissue.label.resize(density.size());
  for (std::size_t v = 0; v < density.size(); ++v) {
    if (densities.isAir(density[v])) continue;
    const std::size_t level = densities.levelAt(v);
    tissue.label[v] = static_cast<std::uint8_t>(kOfLevel[level]);
    share[v] = static_cast<float>(densities.solidAt(v, level));
  }
  tissue.largest_share = keepLargest(grid, tissue.label);
  for (std::size_t v = 0; v < density.size(); ++v)
    if (tissue.label[v] == 0) share[v] = 0.0f;
  if (densities.isPlain()) {
    for (std::size_t v = 0; v < density.size(); ++v) share[v] = isHard(tissue.label[v]) ? 1.0f : 0.0f;
    drawOverThree(grid, share);
  }
  tissue.solid.resize(density.size());
  std::ranges::transform(share, tissue.solid.begin(),
                         [](float one) { return static_cast<std::uint8_t>(255.0f * one + 0.5f); });
  // Less than half a voxel of matter is air, as the tooth's number has it; pulp stays pulp.
  for (std::size_t v = 0; v < density.size(); ++v)
    if (tissue.label[v] != kPulp && tissue.solid[v] < kHalfSolid && !densities.isPlain()) tissue.label[v] = 0;
  return tissue;
}

}  // namespace assets
