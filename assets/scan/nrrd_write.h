// Writes an array as NRRD 4, gzip, little endian, i fastest, axes along P (LPS mm). Equal arrays give equal bytes.
// Throws LoadError if there is no space. Any thread; about 100 MB/s.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "assets/scan/voxel_type.h"
#include "calibration/output_file.h"

namespace assets {

struct NrrdArray {
  VoxelType type;
  std::vector<int> size;
  double spacing_mm = 1.0;
  glm::dvec3 origin_P_mm{0.0};
  std::span<const std::byte> voxels;
};

/// Writes and commits the file.
void writeNrrd(const NrrdArray& array, calibration::OutputFile& file);

}  // namespace assets
