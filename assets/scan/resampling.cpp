#include "assets/scan/resampling.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <type_traits>

#include "assets/load_error.h"
#include "calibration/geometry/pose.h"

namespace assets {

namespace {

using calibration::isFinite;

constexpr double kMaxDrift_voxels = 0.02;
constexpr double kMinSpacing_mm = 0.001;
constexpr double kMaxSpacing_mm = 50.0;
constexpr double kMaxCoordinate_mm = 1.0e6;
constexpr double kMinAxesVolume = 0.02;  // determinant of the unit axes; 0.87 for a gantry tilted by 30 deg

[[noreturn]] void refuse(const std::string& where, const std::string& reason) {
  throw LoadError(where + ": " + reason);
}

double largestOf(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

std::string limitText() { return std::to_string(kMaxVoxels) + " voxels (1024 x 1024 x 1024) are accepted; crop it"; }

/// For each axis of P the file's axis along it within the allowed drift, or -1.
glm::ivec3 axesAlongP(const ScanGeometry& scan, double spacing_mm) {
  glm::ivec3 axis_along_P(-1);
  for (int a = 0; a < 3; ++a) {
    const glm::dvec3 step = scan.step_P_mm[a] / spacing_mm;
    int along = 0;
    for (int p = 1; p < 3; ++p)
      if (std::abs(step[p]) > std::abs(step[along])) along = p;
    glm::dvec3 drift = step;
    drift[along] = std::abs(step[along]) - 1.0;
    if (largestOf(drift) * scan.size[a] <= kMaxDrift_voxels) axis_along_P[along] = a;
  }
  return axis_along_P;
}

template <class Value>
Value rounded(double value) {
  return static_cast<Value>(std::lround(value));
}

}  // namespace

void requireValidGeometry(const ScanGeometry& scan, const std::string& where) {
  if (std::min({scan.size.x, scan.size.y, scan.size.z}) < 1)
    refuse(where, "it holds no voxels; export the volume again");
  if (1.0 * scan.size.x * scan.size.y * scan.size.z > static_cast<double>(kMaxVoxels))
    refuse(where, "it is too large: at most " + limitText());

  glm::dmat3 axes(1.0);
  for (int a = 0; a < 3; ++a) {
    if (!isFinite(scan.step_P_mm[a]) || !isFinite(scan.origin_P_mm))
      refuse(where, "its spacing, directions or origin are not finite numbers; export the volume again");
    const double spacing_mm = glm::length(scan.step_P_mm[a]);
    if (!(spacing_mm >= kMinSpacing_mm && spacing_mm <= kMaxSpacing_mm))
      refuse(where,
             "a voxel spacing of " + std::to_string(spacing_mm) + " mm is outside 0.001 to 50 mm; check its units");
    axes[a] = scan.step_P_mm[a] / spacing_mm;
  }
  if (largestOf(scan.origin_P_mm) > kMaxCoordinate_mm)
    refuse(where, "its origin is more than 1 km away; check its units");
  if (!(std::abs(glm::determinant(axes)) >= kMinAxesVolume))
    refuse(where, "its axes lie in one plane (singular directions); export the volume again");
}

Resampling::Resampling(const ScanGeometry& scan, const std::string& where) : scan_(scan) {
  requireValidGeometry(scan, where);
  grid_.spacing_mm =
      std::min({glm::length(scan.step_P_mm[0]), glm::length(scan.step_P_mm[1]), glm::length(scan.step_P_mm[2])});

  const glm::ivec3 axis_along_P = axesAlongP(scan, grid_.spacing_mm);
  exact_ = std::min({axis_along_P.x, axis_along_P.y, axis_along_P.z}) >= 0;
  if (exact_)
    alignExactly(axis_along_P);
  else
    coverBox(where);
}

void Resampling::alignExactly(const glm::ivec3& axis_along_P) {
  const glm::i64vec3 scan_stride(1, scan_.size.x, std::int64_t{scan_.size.x} * scan_.size.y);
  grid_.origin_P_mm = scan_.origin_P_mm;
  for (int p = 0; p < 3; ++p) {
    const int a = axis_along_P[p];
    grid_.size[p] = scan_.size[a];
    stride_[p] = scan_stride[a];
    if (scan_.step_P_mm[a][p] > 0.0) continue;

    // A flipped axis starts at its far end.
    first_ += (scan_.size[a] - 1) * scan_stride[a];
    grid_.origin_P_mm[p] += (scan_.size[a] - 1) * scan_.step_P_mm[a][p];
    stride_[p] = -stride_[p];
  }
}

void Resampling::coverBox(const std::string& where) {
  // Bounds in P of the file's outer faces.
  glm::dvec3 lowest(INFINITY);
  glm::dvec3 highest(-INFINITY);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 index = glm::dvec3(cornerOffset(corner) * scan_.size) - 0.5;
    const glm::dvec3 p_P_mm = scan_.origin_P_mm + scan_.step_P_mm * index;
    lowest = glm::min(lowest, p_P_mm);
    highest = glm::max(highest, p_P_mm);
  }

  // Ignore slivers below 0.001 voxel, which are rounding.
  const glm::dvec3 extent_voxels = (highest - lowest) / grid_.spacing_mm;
  const glm::dvec3 size = glm::max(glm::ceil(extent_voxels - 1.0e-3), glm::dvec3(1.0));
  if (size.x * size.y * size.z > static_cast<double>(kMaxVoxels))
    refuse(where,
           "as cubic voxels of " + std::to_string(grid_.spacing_mm) + " mm it is too large: at most " + limitText());
  grid_.size = glm::ivec3(size);
  grid_.origin_P_mm = lowest + 0.5 * grid_.spacing_mm;

  const glm::dmat3 scan_index_per_mm = glm::inverse(scan_.step_P_mm);
  scan_index_per_voxel_ = scan_index_per_mm * grid_.spacing_mm;
  scan_index_origin_ = scan_index_per_mm * (grid_.origin_P_mm - scan_.origin_P_mm);
}

namespace {

/// Calls `value(ijk)` for every voxel of the grid, slices in parallel.
template <class Value, class At>
std::vector<Value> filled(const VolumeGrid& grid, const At& value) {
  std::vector<Value> result(grid.voxelCount());
  tbb::parallel_for(tbb::blocked_range<int>(0, grid.size.z), [&](const auto& slices) {
    for (int k = slices.begin(); k != slices.end(); ++k)
      for (int j = 0; j < grid.size.y; ++j) {
        Value* row = result.data() + grid.index({0, j, k});
        for (int i = 0; i < grid.size.x; ++i) row[i] = value(glm::ivec3(i, j, k));
      }
  });
  return result;
}

/// Clamps an index to the file's voxels; false if it lies beyond their outer faces.
bool clampInside(glm::dvec3& index, const glm::ivec3& size) {
  constexpr double kRounding = 1.0e-6;
  for (int a = 0; a < 3; ++a) {
    if (index[a] < -0.5 - kRounding || index[a] > size[a] - 0.5 + kRounding) return false;
    index[a] = std::clamp(index[a], 0.0, size[a] - 1.0);
  }
  return true;
}

template <class Value>
double trilinear(const std::vector<Value>& values, const glm::ivec3& size, const glm::dvec3& index) {
  const glm::ivec3 low = glm::min(glm::ivec3(index), glm::max(size - 2, glm::ivec3(0)));
  const glm::dvec3 above = index - glm::dvec3(low);
  const std::size_t di = size.x > 1 ? 1 : 0;
  const std::size_t dj = size.y > 1 ? indexIn(size, {0, 1, 0}) : 0;
  const std::size_t dk = size.z > 1 ? indexIn(size, {0, 0, 1}) : 0;
  const Value* at = values.data() + indexIn(size, low);
  const auto along_i = [&](std::size_t offset) { return (1.0 - above.x) * at[offset] + above.x * at[offset + di]; };
  const double below = (1.0 - above.y) * along_i(0) + above.y * along_i(dj);
  const double beyond = (1.0 - above.y) * along_i(dk) + above.y * along_i(dj + dk);
  return (1.0 - above.z) * below + above.z * beyond;
}

template <class Value>
std::vector<Value> permuted(const VolumeGrid& grid, std::vector<Value> values, std::int64_t first,
                            const glm::i64vec3& stride) {
  if (stride == glm::i64vec3(1, grid.size.x, std::int64_t{grid.size.x} * grid.size.y)) return values;
  return filled<Value>(grid, [&](const glm::ivec3& ijk) {
    return values[static_cast<std::size_t>(first + ijk.x * stride.x + ijk.y * stride.y + ijk.z * stride.z)];
  });
}

template <class Value>
std::vector<Value> interpolated(const VolumeGrid& grid, const std::vector<Value>& values, const glm::ivec3& size,
                                const glm::dmat3& per_voxel, const glm::dvec3& origin, Value outside) {
  return filled<Value>(grid, [&](const glm::ivec3& ijk) {
    glm::dvec3 index = origin + per_voxel * glm::dvec3(ijk);
    return clampInside(index, size) ? rounded<Value>(trilinear(values, size, index)) : outside;
  });
}

}  // namespace

std::vector<std::int16_t> Resampling::linear(std::vector<std::int16_t> values, std::int16_t outside) const {
  if (exact_) return permuted(grid_, std::move(values), first_, stride_);
  return interpolated(grid_, values, scan_.size, scan_index_per_voxel_, scan_index_origin_, outside);
}

std::vector<std::uint8_t> Resampling::linear(std::vector<std::uint8_t> values, std::uint8_t outside) const {
  if (exact_) return permuted(grid_, std::move(values), first_, stride_);
  return interpolated(grid_, values, scan_.size, scan_index_per_voxel_, scan_index_origin_, outside);
}

std::vector<std::uint8_t> Resampling::nearest(std::vector<std::uint8_t> values, std::uint8_t outside) const {
  if (exact_) return permuted(grid_, std::move(values), first_, stride_);
  return filled<std::uint8_t>(grid_, [&](const glm::ivec3& ijk) {
    glm::dvec3 index = scan_index_origin_ + scan_index_per_voxel_ * glm::dvec3(ijk);
    if (!clampInside(index, scan_.size)) return outside;
    const glm::ivec3 at(glm::round(index));
    return values[indexIn(scan_.size, at)];
  });
}

}  // namespace assets
