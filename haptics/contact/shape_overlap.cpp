#include "haptics/contact/shape_overlap.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "haptics/bone/bur_coverage.h"

namespace haptics {
namespace {

constexpr int kEdge = BurCoverage::kEdge;
constexpr std::size_t kVoxels = BurCoverage::kVoxels;

/// From a block's middle to the middle of its farthest voxel.
const double kBlockReach = 0.5 * (kEdge - 1) * std::sqrt(3.0);

/// Sums in voxels and in steps of 1/255 (1/255² for the greyness).
struct Sums {
  double volume = 0.0, stiff = 0.0, grey = 0.0;
  glm::dvec3 moment_T{0.0};      ///< of voxels cut, along T
  glm::dvec3 moment_index{0.0};  ///< of whole voxels, along i, j, k
  glm::dvec3 area_index{0.0};
};

/// The voxels of a block with one more on every side, in steps of 1/255; air outside the volume.
class Block {
 public:
  static constexpr int kPadded = kEdge + 2;

  void read(const SolidField& field, glm::ivec3 corner) {
    const glm::ivec3 from = corner - 1, to = from + (kPadded - 1);
    const bool inside = field.grid.contains(from) && field.grid.contains(to);
    std::size_t at = 0;
    for (int k = from.z; k <= to.z; ++k)
      for (int j = from.y; j <= to.y; ++j)
        for (int i = from.x; i <= to.x; ++i, ++at)
          solid_[at] = inside || field.grid.contains({i, j, k}) ? field.solidAt({i, j, k}) : std::uint8_t{0};
  }

  /// Neither in it nor beside it.
  bool isAir() const {
    unsigned any = 0;
    for (const std::uint8_t w : solid_) any |= w;
    return any == 0;
  }
  int solid(std::size_t n) const { return solid_[place(n)]; }
  /// Difference of a voxel's neighbours along an axis.
  int rise(std::size_t n, std::size_t axis) const {
    constexpr std::array<std::size_t, 3> kStep = {1, kPadded, kPadded * kPadded};
    return solid_[place(n) + kStep[axis]] - solid_[place(n) - kStep[axis]];
  }

 private:
  static constexpr std::size_t place(std::size_t n) {
    return (n % 4 + 1) + kPadded * ((n / 4 % 4 + 1) + kPadded * (n / 16 + 1));
  }
  std::array<std::uint8_t, kPadded * kPadded * kPadded> solid_;
};

double factorOf(const TissueStiffness& tissue, std::uint8_t label) {
  return tissue.factor[label < assets::kTissueCount ? label : 0];
}

glm::ivec3 voxelOf(glm::ivec3 corner, std::size_t n) {
  const auto voxel = static_cast<int>(n);
  return corner + glm::ivec3(voxel % kEdge, voxel / kEdge % kEdge, voxel / (kEdge * kEdge));
}

/// A block's tissue-weighted steps.
using Stiff = std::array<double, kVoxels>;
void weigh(const SolidField& field, const TissueStiffness& tissue, glm::ivec3 corner, const Block& block,
           Stiff& stiff) {
  for (std::size_t n = 0; n < kVoxels; ++n)
    stiff[n] = block.solid(n) == 0 ? 0.0 : block.solid(n) * factorOf(tissue, field.labelAt(voxelOf(corner, n)));
}

/// A block wholly inside: every voxel counts whole. Integers, but for the stiffness.
void addWhole(const Block& block, const Stiff& stiff, const glm::dvec3& from_centre, Sums& sums) {
  int weight = 0, grey = 0;
  glm::ivec3 place{0}, rise{0};
  for (std::size_t n = 0; n < kVoxels; ++n) {
    const int w = block.solid(n);
    weight += w;
    grey += w * (255 - w);
    place += w * voxelOf({0, 0, 0}, n);
    rise += glm::ivec3(block.rise(n, 0), block.rise(n, 1), block.rise(n, 2));
    sums.stiff += stiff[n];
  }
  sums.volume += weight;
  sums.grey += grey;
  sums.moment_index += glm::dvec3(place) + static_cast<double>(weight) * from_centre;
  sums.area_index -= 0.5 * glm::dvec3(rise);
}

/// A block cut by the head's surface, in four lanes so that the compiler may take four voxels at a time.
void addCut(const Block& block, const Stiff& stiff, const BurCoverage::Shares& shares, Sums& sums) {
  alignas(64) std::array<double, kVoxels> solid;
  alignas(64) std::array<std::array<double, kVoxels>, 3> rise;
  for (std::size_t n = 0; n < kVoxels; ++n) solid[n] = block.solid(n);
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t n = 0; n < kVoxels; ++n) rise[axis][n] = block.rise(n, axis);
  std::array<double, 4> volume{}, stiffness{}, grey{};
  std::array<std::array<double, 4>, 3> moment{}, area{};
  for (std::size_t row = 0; row < kVoxels; row += 4)
    for (std::size_t lane = 0; lane < 4; ++lane) {
      const std::size_t n = row + lane;
      const double covered = solid[n] * shares.fraction[n];
      volume[lane] += covered;
      stiffness[lane] += stiff[n] * shares.fraction[n];
      grey[lane] += covered * (255.0 - solid[n]);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        moment[axis][lane] += solid[n] * shares.moment[axis][n];
        area[axis][lane] -= rise[axis][n] * shares.fraction[n];
      }
    }
  const auto all = [](const std::array<double, 4>& lane) { return (lane[0] + lane[1]) + (lane[2] + lane[3]); };
  sums.volume += all(volume);
  sums.stiff += all(stiffness);
  sums.grey += all(grey);
  sums.moment_T += glm::dvec3(all(moment[0]), all(moment[1]), all(moment[2]));
  sums.area_index += 0.5 * glm::dvec3(all(area[0]), all(area[1]), all(area[2]));
}

ShapeOverlap scaled(const Sums& sums, const BurCoverage& bur, double s) {
  const glm::dmat3 to_P = glm::transpose(bur.to_T);
  const double voxel = s * s * s / 255.0;
  return {sums.volume * voxel,
          {(to_P * sums.moment_T + sums.moment_index) * (voxel * s)},
          {sums.area_index * (s * s / 255.0)},
          sums.stiff * voxel,
          sums.grey * voxel / 255.0};
}

/// A surface at the volume's end has half its area in the voxels beyond.
constexpr int kBeyond = 1;

}  // namespace

ShapeOverlap shapeOverlap(const SolidField& field, const BurShape& shape,
                          const calibration::Pose<calibration::Patient, calibration::Tool>& X_PT,
                          const TissueStiffness& tissue) noexcept {
  const BurCoverage bur(field.grid, shape, X_PT, kBeyond);
  if (bur.empty()) return {};
  Sums sums;
  Block block;
  Stiff stiff;
  BurCoverage::Shares shares;
  const double reach = kBlockReach + bur.voxel_reach;
  const glm::ivec3 first = (bur.first + kEdge) / kEdge - 1, last = (bur.last + kEdge) / kEdge - 1;
  for (int k = first.z; k <= last.z; ++k)
    for (int j = first.y; j <= last.y; ++j)
      for (int i = first.x; i <= last.x; ++i) {
        const glm::ivec3 corner = kEdge * glm::ivec3(i, j, k);
        const glm::dvec3 from_centre = glm::dvec3(corner) - bur.centre;
        const double beyond = bur.beyondFaces(bur.to_T * (from_centre + 0.5 * (kEdge - 1)));
        if (beyond >= reach) continue;
        block.read(field, corner);
        if (block.isAir()) continue;
        weigh(field, tissue, corner, block, stiff);
        if (beyond <= -reach) {
          addWhole(block, stiff, from_centre, sums);
        } else {
          bur.sharesOf(corner, shares);
          addCut(block, stiff, shares, sums);
        }
      }
  return scaled(sums, bur, field.grid.spacing_mm);
}

ShapeOverlap shapeOverlapVoxelByVoxel(const SolidField& field, const BurShape& shape,
                                      const calibration::Pose<calibration::Patient, calibration::Tool>& X_PT,
                                      const TissueStiffness& tissue) {
  const BurCoverage bur(field.grid, shape, X_PT, kBeyond);
  const auto solidAt = [&](glm::ivec3 ijk) {
    return field.grid.contains(ijk) ? static_cast<double>(field.solidAt(ijk)) : 0.0;
  };
  Sums sums;
  for (int k = bur.first.z; k <= bur.last.z; ++k)
    for (int j = bur.first.y; j <= bur.last.y; ++j)
      for (int i = bur.first.x; i <= bur.last.x; ++i) {
        const glm::ivec3 ijk{i, j, k};
        const VoxelShare share = bur.shareAt(ijk);
        for (int axis = 0; axis < 3; ++axis) {
          glm::ivec3 step{0};
          step[axis] = 1;
          sums.area_index[axis] -= 0.5 * share.fraction * (solidAt(ijk + step) - solidAt(ijk - step));
        }
        const double w = solidAt(ijk);
        if (w == 0.0) continue;
        sums.volume += w * share.fraction;
        sums.stiff += w * share.fraction * factorOf(tissue, field.labelAt(ijk));
        sums.grey += w * (255.0 - w) * share.fraction;
        sums.moment_T += w * share.moment;
      }
  return scaled(sums, bur, field.grid.spacing_mm);
}

}  // namespace haptics
