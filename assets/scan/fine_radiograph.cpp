#include "assets/scan/fine_radiograph.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "assets/trilinear.h"

namespace assets {
namespace {

constexpr double kAround_mm = 0.45;  ///< of the tooth is fine too; then it passes into the scan

/// Of the fine grid, for every voxel of the scan: 255 in the tooth and a little around, down to 0 over two voxels.
std::vector<float> fineShares(const CtVolume& ct, int fdi, const VolumeGrid& fine) {
  const glm::ivec3 size = ct.grid.size;
  const glm::dvec3 high_P = fine.centre_P_mm(fine.size - 1);
  const auto is_held = [&](glm::ivec3 ijk) {
    const glm::dvec3 p_P = ct.grid.centre_P_mm(ijk);
    return glm::all(glm::greaterThan(p_P, fine.origin_P_mm)) && glm::all(glm::lessThan(p_P, high_P));
  };
  const int around = static_cast<int>(kAround_mm / ct.grid.spacing_mm);
  std::vector<float> share(ct.grid.voxelCount());
  forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (ct.tooth[v] != fdi) return;
    forVoxels(glm::max(ijk - around, glm::ivec3(0)), glm::min(ijk + around + 1, size),
              [&](glm::ivec3 near) { share[ct.grid.index(near)] = is_held(near) ? 255.0F : 0.0F; });
  });
  // Smoothed twice along each axis.
  const std::array<std::size_t, 3> step{1, static_cast<std::size_t>(size.x),
                                        static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y)};
  for (int pass = 0; pass < 2; ++pass)
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<float> smooth = share;
      forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
        if (ijk[axis] == 0 || ijk[axis] + 1 == size[axis] || !is_held(ijk)) return;
        const std::size_t way = step[static_cast<std::size_t>(axis)];
        smooth[v] = 0.25F * share[v - way] + 0.5F * share[v] + 0.25F * share[v + way];
      });
      share = std::move(smooth);
    }
  return share;
}

std::uint8_t byteOf(double share) { return static_cast<std::uint8_t>(std::lround(std::clamp(share, 0.0, 255.0))); }

}  // namespace

std::vector<float> fineRadiographOf(const CtVolume& ct, int fdi, const ToothSampler& tooth,
                                    const PeriapicalView& view) {
  const VolumeGrid& fine = tooth.grid();
  const std::vector<float> of_fine = fineShares(ct, fdi, fine);
  std::vector<std::uint8_t> share(of_fine.size());
  std::ranges::transform(of_fine, share.begin(), [](float of) { return byteOf(255.0 - static_cast<double>(of)); });
  std::vector<float> bone_mm = radiographOf(ct.grid, ct.solid, ct.label, view, share);

  std::vector<std::uint8_t> solid(fine.voxelCount()), label(fine.voxelCount());
  share.assign(fine.voxelCount(), 0);
  forVoxels(fine, [&](glm::ivec3 ijk, std::size_t v) {
    share[v] = byteOf(trilinearAt(ct.grid, fine.centre_P_mm(ijk), [&](glm::ivec3 at) {
      return ct.grid.contains(at) ? static_cast<double>(of_fine[ct.grid.index(at)]) : 0.0;
    }));
  });
  const auto fill = [&](glm::ivec3 block, const auto& value) {
    std::size_t within = 0;
    constexpr int kEdge = ToothSampler::kEdge;
    forVoxels(kEdge * block, kEdge * (block + 1), [&](glm::ivec3 ijk) { value(fine.index(ijk), within++); });
  };
  forBlocks(
      tooth,
      [&](glm::ivec3 block, ToothSampler::Same same) {
        fill(block, [&](std::size_t v, std::size_t) { solid[v] = same.solid, label[v] = same.label; });
      },
      [&](glm::ivec3 block, const auto& solids, const auto& labels) {
        fill(block, [&](std::size_t v, std::size_t n) { solid[v] = solids[n], label[v] = labels[n]; });
      });
  const std::vector<float> of_tooth_mm = radiographOf(fine, solid, label, view, share);
  std::ranges::transform(bone_mm, of_tooth_mm, bone_mm.begin(), std::plus{});
  return bone_mm;
}

}  // namespace assets
