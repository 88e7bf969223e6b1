#include "assets/scan/tooth_division.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <optional>

#include "assets/tissue.h"

namespace assets {
namespace {

constexpr std::uint32_t kHardWeight = 50;

struct IndexBox {
  glm::ivec3 first{0}, end{0};
};

/// The voxels of the tooth, in whole bricks with a margin of a voxel.
std::optional<IndexBox> boxOf(const VolumeGrid& grid, std::span<const std::uint8_t> is_tooth) {
  glm::ivec3 low(grid.size), high(-1);
  forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (is_tooth[v] == 0) return;
    low = glm::min(low, ijk);
    high = glm::max(high, ijk);
  });
  if (high.x < 0) return std::nullopt;
  low = glm::max(low - 1, glm::ivec3(0));
  return IndexBox{low / kBrickVoxels * kBrickVoxels, (high + 1 + kBrickVoxels) / kBrickVoxels * kBrickVoxels};
}

/// The 27 voxels around one: weight of the tooth and of the rest, and their heaviest labels.
class Surroundings {
 public:
  Surroundings(const VolumeGrid& grid, std::span<const std::uint8_t> solid, std::span<const std::uint8_t> label,
               std::span<const std::uint8_t> is_tooth, glm::ivec3 centre) {
    forVoxels(glm::max(centre - 1, glm::ivec3(0)), glm::min(centre + 2, grid.size), [&](glm::ivec3 ijk) {
      const std::size_t v = grid.index(ijk);
      const glm::ivec3 away = glm::abs(ijk - centre);
      const std::uint8_t tissue = label.empty() ? std::uint8_t{0} : label[v];
      const std::uint32_t near = 8u >> (away.x + away.y + away.z);
      const std::uint32_t weight = near * solid[v] * (isHard(tissue) ? kHardWeight : 1u);
      Side& side = is_tooth[v] != 0 ? tooth : rest;
      side.weight += weight;
      side.by_label[tissue < kTissueCount ? tissue : 0] += weight;
    });
  }

  struct Side {
    std::uint32_t weight = 0;
    std::array<std::uint32_t, kTissueCount> by_label{};

    std::uint8_t heaviestLabel() const {
      return static_cast<std::uint8_t>(std::ranges::max_element(by_label) - by_label.begin());
    }
  } tooth, rest;

  /// Rounded to the nearest.
  std::uint8_t toothPartOf(std::uint8_t solid) const {
    const std::uint64_t all = std::uint64_t{tooth.weight} + rest.weight;
    return all == 0 ? std::uint8_t{0}
                    : static_cast<std::uint8_t>((solid * std::uint64_t{tooth.weight} + all / 2) / all);
  }
};

}  // namespace

ToothDivision divideByTooth(const VolumeGrid& grid, std::span<const std::uint8_t> solid,
                            std::span<const std::uint8_t> label, std::span<const std::uint8_t> is_tooth) {
  assert(solid.size() == grid.voxelCount() && (label.empty() || label.size() == solid.size()));
  assert(is_tooth.empty() || is_tooth.size() == solid.size());
  ToothDivision division;
  division.jaw = {grid, {solid.begin(), solid.end()}, {label.begin(), label.end()}};
  const auto box = is_tooth.empty() ? std::nullopt : boxOf(grid, is_tooth);
  if (!box) return division;

  BodyVolume& tooth = division.tooth;
  division.first_brick = box->first / kBrickVoxels;
  tooth.grid = {box->end - box->first, grid.spacing_mm, grid.centre_P_mm(box->first)};
  tooth.solid.assign(tooth.grid.voxelCount(), 0);
  if (!label.empty()) tooth.label.assign(tooth.grid.voxelCount(), 0);
  forVoxels(box->first, glm::min(box->end, grid.size), [&](glm::ivec3 ijk) {
    const std::size_t v = grid.index(ijk), at = tooth.grid.index(ijk - box->first);
    if (solid[v] == 0) return;
    const Surroundings around(grid, solid, label, is_tooth, ijk);
    if (around.tooth.weight == 0) return;
    tooth.solid[at] = around.toothPartOf(solid[v]);
    division.jaw.solid[v] = static_cast<std::uint8_t>(solid[v] - tooth.solid[at]);
    if (label.empty()) return;
    const bool inside = is_tooth[v] != 0;
    tooth.label[at] = inside ? label[v] : around.tooth.heaviestLabel();
    if (inside && division.jaw.solid[v] > 0) division.jaw.label[v] = around.rest.heaviestLabel();
  });
  return division;
}

}  // namespace assets
