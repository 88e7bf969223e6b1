#include "haptics/body/tooth_survey.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "haptics/body/principal_axes.h"

namespace haptics {
namespace {

constexpr double kBeyondAnyTooth_mm = 100.0;

using Counts = std::function<bool(std::size_t brick, std::size_t part)>;

/// The box along the principal axes of the places that count, kRegionMargin_mm wider on every side. A flat cut goes on
/// through the whole tooth: below its floor stands what is to be measured.
CutRegion regionAround(const Components& components, std::span<const std::vector<BrickPart>> lost,
                       const Counts& counts) {
  const assets::VolumeGrid& grid = components.grid();
  const auto for_counted = [&](const auto& visit) {
    forBricks(components.bricks(), [&](std::size_t brick, glm::ivec3 corner) {
      for (std::size_t n = 0; n < lost[brick].size(); ++n)
        if (counts(brick, n)) visit(lost[brick][n], corner);
    });
  };
  VoxelMoments moments;
  for_counted([&](const BrickPart& part, glm::ivec3) { moments += part.moments; });
  const ToothPiece mass = massOf(moments, grid);
  const glm::dmat3 axes = principalAxes(mass.inertia_mm5), into = glm::transpose(axes);

  glm::dvec3 low_mm(0.0), high_mm(0.0);
  for_counted([&](const BrickPart& part, glm::ivec3 corner) {
    assets::forVoxels(glm::ivec3(0), glm::ivec3(assets::kBrickVoxels), [&](glm::ivec3 within) {
      if (!holds(part.mask, within)) return;
      const glm::dvec3 at_mm = into * (grid.centre_P_mm(corner + within) - mass.centroid_mm);
      low_mm = glm::min(low_mm, at_mm);
      high_mm = glm::max(high_mm, at_mm);
    });
  });
  // Flat: one side less than half of the next.
  const glm::dvec3 extent_mm = high_mm - low_mm;
  const int thin =
      extent_mm.x < extent_mm.y ? (extent_mm.x < extent_mm.z ? 0 : 2) : (extent_mm.y < extent_mm.z ? 1 : 2);
  const double next_mm = std::min(extent_mm[(thin + 1) % 3], extent_mm[(thin + 2) % 3]);
  const bool is_flat = extent_mm[thin] < 0.5 * next_mm;
  const glm::dvec3 centre_mm = mass.centroid_mm + axes * (0.5 * (low_mm + high_mm));
  glm::dvec3 margin_mm(is_flat ? kBeyondAnyTooth_mm : kRegionMargin_mm);
  margin_mm[thin] = kRegionMargin_mm;
  low_mm -= margin_mm + 0.5 * grid.spacing_mm;
  high_mm += margin_mm + 0.5 * grid.spacing_mm;

  // The voxels of the upright box around it that lie in it.
  glm::dvec3 first(1e9), last(-1e9);
  for (int n = 0; n < 8; ++n) {
    const glm::dvec3 corner_mm = glm::mix(low_mm, high_mm, glm::dvec3(assets::cornerOffset(n)));
    const glm::dvec3 index = grid.indexFromPoint(mass.centroid_mm + axes * corner_mm);
    first = glm::min(first, index);
    last = glm::max(last, index);
  }
  CutRegion region{VoxelBox(grid, first, last), {}, is_flat ? axes[thin] : glm::dvec3(0.0), centre_mm};
  region.zone.assign(assets::countIn(region.box.last - region.box.first + 1), 0);
  const glm::dvec3 along_i_mm = grid.spacing_mm * into[0];
  std::size_t at = 0;
  for (int k = region.box.first.z; k <= region.box.last.z; ++k)
    for (int j = region.box.first.y; j <= region.box.last.y; ++j) {
      // Of a row, those between its crossings of each pair of faces.
      const glm::ivec3 start(region.box.first.x, j, k);
      const glm::dvec3 from_mm = into * (grid.centre_P_mm(start) - mass.centroid_mm);
      double first_i = 0.0, last_i = region.box.last.x - region.box.first.x;
      for (int axis = 0; axis < 3; ++axis) {
        const double step_mm = along_i_mm[axis], below_mm = low_mm[axis] - from_mm[axis],
                     above_mm = high_mm[axis] - from_mm[axis];
        if (std::abs(step_mm) < 1e-12) {
          if (below_mm > 0.0 || above_mm < 0.0) last_i = -1.0;
          continue;
        }
        first_i = std::max(first_i, std::ceil(std::min(below_mm / step_mm, above_mm / step_mm)));
        last_i = std::min(last_i, std::floor(std::max(below_mm / step_mm, above_mm / step_mm)));
      }
      const auto row = region.zone.begin() + static_cast<std::ptrdiff_t>(at);
      if (first_i <= last_i)
        std::fill(row + static_cast<int>(first_i), row + static_cast<int>(last_i) + 1, std::uint8_t{1});
      at += static_cast<std::size_t>(region.box.last.x - region.box.first.x + 1);
    }
  return region;
}

}  // namespace

ToothSurvey::ToothSurvey(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid)
    : components_(grid, solid), uncut_(assets::countIn(components_.bricks())) {
  for (std::size_t brick = 0; brick < uncut_.size(); ++brick) uncut_[brick] = components_.maskOf(brick);
}

ToothFindings ToothSurvey::pieces() {
  components_.join();
  ToothFindings found;
  for (const ToothPiece& piece : components_.pieces()) {
    if (piece.volume_mm3 < kLeastPiece_mm3) {
      ++found.chips;
      found.chips_mm3 += piece.volume_mm3;
    } else if (found.pieces++ < kMostPieces) {
      found.piece[found.pieces - 1] = piece;
    }
  }
  return found;
}

/// Around the largest connected place that was cut, then around all of them.
std::vector<CutRegion> ToothSurvey::cutRegions(double& cut_mm3) const {
  std::vector<std::vector<BrickPart>> lost(uncut_.size());
  forBricks(components_.bricks(), [&](std::size_t brick, glm::ivec3 corner) {
    BrickMask gone = components_.maskOf(brick);
    for (std::size_t k = 0; k < gone.size(); ++k) gone[k] = uncut_[brick][k] & ~gone[k];
    if (!isEmpty(gone)) findParts(gone, corner, lost[brick]);
  });
  PartJoin places;
  places.unite(components_.bricks(), lost);
  std::vector<std::int64_t> voxels(places.count(), 0);
  std::int64_t all = 0;
  for (std::size_t brick = 0; brick < lost.size(); ++brick)
    for (std::size_t n = 0; n < lost[brick].size(); ++n) {
      voxels[places.rootOf(brick, n)] += lost[brick][n].moments.count;
      all += lost[brick][n].moments.count;
    }
  cut_mm3 = static_cast<double>(all) * components_.grid().voxelVolume_mm3();
  if (all == 0) return {};

  const auto largest = static_cast<std::size_t>(std::ranges::max_element(voxels) - voxels.begin());
  std::vector<CutRegion> regions{regionAround(
      components_, lost, [&](std::size_t brick, std::size_t part) { return places.rootOf(brick, part) == largest; })};
  if (voxels[largest] != all)
    regions.push_back(regionAround(components_, lost, [](std::size_t, std::size_t) { return true; }));
  return regions;
}

void ToothSurvey::findBridges(ToothFindings& findings, double cell_mm) const {
  const std::vector<CutRegion> regions = cutRegions(findings.cut_mm3);
  for (std::size_t piece = 0; piece < std::min(findings.pieces, kMostPieces); ++piece) {
    ToothFindings::Held& held = findings.held[piece];
    for (const CutRegion& region : regions) {
      const BridgeSearch search(components_, piece, region, cell_mm);
      held = {};
      held.parts = search.parts().size();
      std::ranges::copy(search.parts(), held.part.begin());
      held.bridges = search.bridges().size();
      std::ranges::copy(search.bridges(), held.bridge.begin());
      if (held.parts >= 2) break;
    }
  }
}

}  // namespace haptics
