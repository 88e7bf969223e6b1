#include "assets/segment/voxel_edits.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>

#include "assets/segment/cell_masks.h"
#include "assets/tissue.h"
#include "assets/tooth.h"

namespace assets {
namespace {

/// Of a voxel that is painted so.
VoxelLabel paintedLabel(const GreyLevels& levels, std::uint8_t as, double hu, VoxelLabel before) {
  const auto value = [](Tissue tissue) { return static_cast<std::uint8_t>(tissue); };
  if (as == kPaintNothing) return {};
  if (as == kPaintBone) return {value(hu > levels.thinBone_hu() ? Tissue::cortical : Tissue::trabecular), 0};
  if (before.tooth != 0) return {before.label, as};
  return {value(hu > levels.enamel_hu() ? Tissue::enamel : Tissue::dentine), as};
}

/// Distance from a piece of the way.
double away(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 ab = b - a;
  const double length2 = glm::dot(ab, ab);
  const double share = length2 > 0.0 ? std::clamp(glm::dot(p - a, ab) / length2, 0.0, 1.0) : 0.0;
  return glm::distance(p, a + share * ab);
}

class VoxelPainter {
 public:
  VoxelPainter(const VoxelScene& scene, const JawSegmentation& jaw, const ChangeVoxel& change)
      : scene_(scene), jaw_(jaw), change_(change) {}

  void paint(const BrushStroke& stroke, std::size_t first) const {
    const VolumeGrid& grid = scene_.grid;
    const double reach = stroke.radius_mm / grid.spacing_mm;
    for (std::size_t n = first; n < stroke.way_P_mm.size(); ++n) {
      const glm::dvec3 to = grid.indexFromPoint(stroke.way_P_mm[n]),
                       from = n == 0 ? to : grid.indexFromPoint(stroke.way_P_mm[n - 1]);
      const glm::dvec3 last(grid.size - 1), none(0.0);
      const glm::ivec3 low(glm::clamp(glm::ceil(glm::min(from, to) - reach), none, last)),
          high(glm::clamp(glm::floor(glm::max(from, to) + reach), none, last));
      forVoxels(low, high + 1, [&](glm::ivec3 ijk) {
        if (away(glm::dvec3(ijk), from, to) > reach) return;
        const std::size_t v = grid.index(ijk);
        const double hu = scene_.hounsfield[v];
        if (hu >= stroke.low_hu && hu <= stroke.high_hu) give(ijk, v, stroke.as, hu);
      });
    }
  }

  void cut(const JawCut& cut) const {
    const VolumeGrid& grid = scene_.grid;
    const glm::dvec3 line = cut.to_P_mm - cut.from_P_mm;
    const double length_mm = glm::length(line);
    if (length_mm < 1e-6) return;
    const glm::dvec3 along = line / length_mm, towards = cut.beyond_P_mm - cut.from_P_mm,
                     off = towards - glm::dot(towards, along) * along;
    if (glm::length(off) < 1e-6) return;
    const glm::dvec3 beyond = glm::normalize(off), across = glm::cross(along, beyond);
    forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
      if (jaw_.label[v] == 0) return;
      const glm::dvec3 d = grid.centre_P_mm(ijk) - cut.from_P_mm;
      const double at_mm = glm::dot(d, along);
      if (at_mm >= 0.0 && at_mm <= length_mm && glm::dot(d, beyond) > 0.0 &&
          std::abs(glm::dot(d, across)) <= kCutDepth_mm)
        give(ijk, v, kPaintNothing, 0.0);
    });
  }

 private:
  void give(const glm::ivec3& ijk, std::size_t v, std::uint8_t as, double hu) const {
    const VoxelLabel before{jaw_.label[v], jaw_.tooth[v]}, to = paintedLabel(jaw_.levels, as, hu, before);
    if (to.label != before.label || to.tooth != before.tooth) change_(ijk, v, to);
  }

  const VoxelScene& scene_;
  const JawSegmentation& jaw_;
  const ChangeVoxel& change_;
};

}  // namespace

void forVoxelsChangedBy(const VoxelScene& scene, const JawSegmentation& jaw, const VoxelEdit& edit, std::size_t first,
                        const ChangeVoxel& change) {
  const VoxelPainter painter(scene, jaw, change);
  if (const auto* const stroke = std::get_if<BrushStroke>(&edit)) painter.paint(*stroke, first);
  if (const auto* const cut = std::get_if<JawCut>(&edit)) painter.cut(*cut);
}

void ToothCounts::add(const glm::ivec3& ijk, std::uint8_t tooth, int times) {
  Of& one = of[tooth];
  one.voxels += times;
  for (int a = 0; a < 3; ++a) one.sum[static_cast<std::size_t>(a)] += std::int64_t{times} * ijk[a];
}

ToothCounts toothCounts(const VolumeGrid& grid, const std::vector<std::uint8_t>& tooth) {
  return tbb::parallel_reduce(
      tbb::blocked_range<int>(0, grid.size.z), ToothCounts{},
      [&](const tbb::blocked_range<int>& layers, ToothCounts counts) {
        forVoxels({0, 0, layers.begin()}, {grid.size.x, grid.size.y, layers.end()}, [&](glm::ivec3 ijk) {
          if (const std::uint8_t number = tooth[grid.index(ijk)]; number != 0) counts.add(ijk, number, 1);
        });
        return counts;
      },
      [](ToothCounts a, const ToothCounts& b) {
        for (std::size_t n = 0; n < a.of.size(); ++n) {
          a.of[n].voxels += b.of[n].voxels;
          for (std::size_t axis = 0; axis < 3; ++axis) a.of[n].sum[axis] += b.of[n].sum[axis];
        }
        return a;
      });
}

void takeCounts(const VolumeGrid& grid, const ToothCounts& counts, JawSegmentation& jaw) {
  std::erase_if(jaw.teeth, [&](const FoundTooth& tooth) {
    return tooth.fdi != 0 && counts.of[static_cast<std::size_t>(tooth.fdi)].voxels <= 0;
  });
  for (int fdi = 1; fdi < 256; ++fdi) {
    const ToothCounts::Of& of = counts.of[static_cast<std::size_t>(fdi)];
    if (of.voxels <= 0) continue;
    auto found = std::ranges::find(jaw.teeth, fdi, &FoundTooth::fdi);
    if (found == jaw.teeth.end()) {
      FoundTooth painted;
      painted.fdi = painted.told_fdi = fdi;
      painted.is_apart = true;
      found = jaw.teeth.insert(jaw.teeth.end(), painted);
    }
    const auto count = static_cast<double>(of.voxels);
    found->volume_mm3 = count * grid.voxelVolume_mm3();
    const glm::dvec3 sum(of.sum[0], of.sum[1], of.sum[2]);
    found->centre_P_mm = grid.origin_P_mm + grid.spacing_mm * sum / count;
  }
  // From the right to the left along the arch, pieces without a number last.
  std::ranges::stable_sort(jaw.teeth, {}, [](const FoundTooth& tooth) {
    if (tooth.fdi == 0) return 100;
    return isRight(tooth.fdi) ? -positionOf(tooth.fdi) : positionOf(tooth.fdi);
  });
}

void applyVoxelEdits(const VoxelScene& scene, std::span<const VoxelEdit> edits, JawSegmentation& jaw) {
  if (edits.empty() || jaw.label.empty()) return;
  for (const VoxelEdit& edit : edits)
    forVoxelsChangedBy(scene, jaw, edit, 0, [&jaw](const glm::ivec3&, std::size_t v, VoxelLabel to) {
      jaw.label[v] = to.label, jaw.tooth[v] = to.tooth;
    });
  takeCounts(scene.grid, toothCounts(scene.grid, jaw.tooth), jaw);
}

std::array<double, 2> greyLikeAt(const VoxelScene& scene, const glm::dvec3& p_P_mm) {
  const glm::ivec3 at(glm::floor(scene.grid.indexFromPoint(p_P_mm) + 0.5));
  double sum = 0.0, count = 0.0;
  forVoxels(glm::max(at - 1, glm::ivec3(0)), glm::min(at + 2, scene.grid.size),
            [&](glm::ivec3 ijk) { sum += scene.hounsfield[scene.grid.index(ijk)], count += 1.0; });
  if (count == 0.0) return {-32768.0, 32767.0};
  return {std::round(sum / count - kAlike_hu), std::round(sum / count + kAlike_hu)};
}

}  // namespace assets
