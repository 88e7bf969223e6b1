// Maps the voxels of a file to a VolumeGrid: cubic voxels of the smallest spacing along P (LPS), for any axis order,
// flips, oblique axes and non-cubic spacing. A scan with cubic voxels whose axes lie along P (both within 0.02 voxel
// over the whole extent) is copied, permuted and flipped exactly. Others are interpolated; the new box encloses the old
// one's outer faces, the border value holds half a voxel outwards, beyond it is `outside`. Any thread; parallel (TBB).
// 2 ns a voxel copied, 20 interpolated. Throws LoadError for invalid geometry (not finite, singular, spacing) or more
// than kMaxVoxels.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "assets/volume_grid.h"

namespace assets {

/// The largest volume accepted, in a file or resampled: 1024^3, 4 GB as a CtVolume.
inline constexpr std::int64_t kMaxVoxels = std::int64_t{1} << 30;

/// Voxel positions of a file.
struct ScanGeometry {
  glm::ivec3 size{0};
  glm::dmat3 step_P_mm{1.0};    ///< column a: from a voxel to the next along the file's axis a
  glm::dvec3 origin_P_mm{0.0};  ///< centre of the first voxel
};

/// Throws LoadError: not finite, singular, spacing outside 0.001 to 50 mm, no or too many voxels.
void requireValidGeometry(const ScanGeometry& scan, const std::string& where);

class Resampling {
 public:
  /// `where` names the file in messages.
  Resampling(const ScanGeometry& scan, const std::string& where);

  const VolumeGrid& grid() const { return grid_; }
  bool isExact() const { return exact_; }

  /// Values in the file's order to values on grid().
  std::vector<std::int16_t> linear(std::vector<std::int16_t> values, std::int16_t outside) const;
  std::vector<std::uint8_t> linear(std::vector<std::uint8_t> values, std::uint8_t outside) const;
  std::vector<std::uint8_t> nearest(std::vector<std::uint8_t> values, std::uint8_t outside) const;

 private:
  void alignExactly(const glm::ivec3& axis_along_P);
  void coverBox(const std::string& where);

  ScanGeometry scan_;
  VolumeGrid grid_;
  bool exact_ = false;
  std::int64_t first_ = 0;              ///< exact: index in the file of voxel (0,0,0)
  glm::i64vec3 stride_{0};              ///< exact: index steps in the file per voxel
  glm::dmat3 scan_index_per_voxel_{1};  ///< interpolated: continuous file index = origin + matrix * ijk
  glm::dvec3 scan_index_origin_{0.0};
};

}  // namespace assets
