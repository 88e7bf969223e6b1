// What a volume file says of itself, judged before one of its voxels is read: NRRD, NIfTI-1 and MetaImage, by extension
// (nrrd_header.h, nifti_header.h, meta_header.h). A header that comes back is complete: three axes, sizes, a type, a
// place in P (LPS mm, units obeyed), and the files that hold the voxels, each a plain file in the header's folder or
// below. Everything else is a LoadError of one line. No number is made up: where spacing or byte order matters and is
// not stated, the file is refused; where NRRD or MetaImage do not state which way their axes lie, they are taken along
// LPS, as their own readers do, and `orientation_known` says so. Any thread; reads at most 1 MB. Voxels: voxel_bytes.h.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "assets/scan/resampling.h"
#include "assets/scan/voxel_type.h"

namespace assets {

/// gzip also stands for a bare zlib stream, as MetaImage has it; text and hex are for people to read.
enum class VoxelCoding { raw, gzip, text, hex };

/// A file with an equal share of the voxels, behind its first bytes as they are stored.
struct VoxelFile {
  std::string path;
  std::uint64_t from_byte = 0;
};

struct ImageHeader {
  std::string path;
  ScanGeometry geometry;
  bool orientation_known = true;  ///< the file itself says which way its axes lie
  VoxelType type = VoxelType::int16;
  VoxelCoding coding = VoxelCoding::raw;
  bool is_big_endian = false;
  double slope = 1.0;
  double intercept = 0.0;  ///< value = slope * stored + intercept
  std::vector<VoxelFile> files;

  /// In each file, ahead of the voxels: lines, then bytes of what is unpacked. kVoxelsAtFileEnd: as many bytes as
  /// there are ahead of the last voxels.
  std::int64_t skipped_lines = 0;
  std::int64_t skipped_bytes = 0;

  bool isRescaled() const { return slope != 1.0 || intercept != 0.0; }
  std::uint64_t voxelCount() const {
    return static_cast<std::uint64_t>(geometry.size.x) * static_cast<std::uint64_t>(geometry.size.y) *
           static_cast<std::uint64_t>(geometry.size.z);
  }
};

inline constexpr std::int64_t kVoxelsAtFileEnd = -1;

ImageHeader readImageHeader(const std::string& path);

}  // namespace assets
