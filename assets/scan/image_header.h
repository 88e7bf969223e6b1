// Header of a volume file, validated before voxels are read: NRRD, NIfTI-1 and MetaImage, by extension. A returned
// header is complete: three axes, sizes, type, geometry in P (LPS mm), and the data files, each a regular file in the
// header's folder or below. Otherwise LoadError of one line. Nothing is assumed that matters: without spacing or byte
// order the file is rejected; without axis directions NRRD and MetaImage are taken as LPS, as their own readers do, and
// `orientation_known` is false. Any thread; reads at most 1 MB. Voxels: voxel_bytes.h.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "assets/scan/resampling.h"
#include "assets/scan/voxel_type.h"

namespace assets {

/// gzip includes a bare zlib stream (MetaImage).
enum class VoxelCoding { raw, gzip, text, hex };

/// A file with an equal share of the voxels, which begin at `from_byte`.
struct VoxelFile {
  std::string path;
  std::uint64_t from_byte = 0;
};

struct ImageHeader {
  std::string path;
  ScanGeometry geometry;
  bool orientation_known = true;  ///< stated in the file
  VoxelType type = VoxelType::int16;
  VoxelCoding coding = VoxelCoding::raw;
  bool is_big_endian = false;
  double slope = 1.0;
  double intercept = 0.0;  ///< value = slope * stored + intercept
  std::vector<VoxelFile> files;

  /// To skip in each file ahead of the voxels: lines, then bytes after decompression, or kVoxelsAtFileEnd.
  std::int64_t skipped_lines = 0;
  std::int64_t skipped_bytes = 0;

  bool isRescaled() const { return slope != 1.0 || intercept != 0.0; }
  std::uint64_t voxelCount() const { return countIn(geometry.size); }
};

/// The voxels are the last bytes of the file.
inline constexpr std::int64_t kVoxelsAtFileEnd = -1;

ImageHeader readImageHeader(const std::string& path);

}  // namespace assets
