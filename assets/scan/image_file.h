// Volumes as image files. Reads NRRD (.nrrd .nhdr), NIfTI (.nii .nii.gz) and MetaImage (.mha .mhd) with any axis order,
// flips, oblique axes, RAS or LPS, non-cubic voxels, integer or float types, rescaled if stated; the result is a
// VolumeGrid in P (LPS mm), see resampling.h. Writes gzip NRRD, LPS, i fastest. Throws LoadError of one line: as
// image_header.h and voxel_bytes.h, values that are not finite or out of range, no or invalid geometry, more than
// kMaxVoxels. Header and file lengths are checked before voxels are read; zlib is the only library that sees foreign
// bytes. Any thread; about 1 s per 10^8 voxels. Not DICOM.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "assets/scan/grey_window.h"
#include "assets/volume_grid.h"
#include "calibration/output_file.h"

namespace assets {

struct HounsfieldImage {
  VolumeGrid grid;
  std::vector<std::int16_t> hounsfield;
  bool orientation_known = true;  ///< stated in the file; LPS is assumed otherwise
  double coarsest_mm = 0.0;       ///< the file's largest step from voxel to voxel
};

/// One byte a voxel: solid fraction or labels.
struct ByteImage {
  VolumeGrid grid;
  std::vector<std::uint8_t> values;
};

inline constexpr std::int16_t kAirHu = -1000;

/// Linear interpolation where needed; air outside. 8-bit grey values need a window.
HounsfieldImage readHounsfield(const std::string& path, const std::optional<GreyWindow>& window = std::nullopt);
/// Values 0..255; linear interpolation where needed; 0 outside.
ByteImage readSolid(const std::string& path);
/// Integers 0..255; nearest voxel where needed; 0 outside.
ByteImage readLabels(const std::string& path);

/// Same size, and no voxel centre differs by more than 0.01 voxel.
bool isSameGrid(const VolumeGrid& a, const VolumeGrid& b);

/// The file for the writers below; throws if the name does not end in .nrrd.
calibration::OutputFile nrrdOutput(const std::string& path, bool overwrite);

/// The writers fill `file` and commit it.
void writeHounsfield(const VolumeGrid& grid, const std::vector<std::int16_t>& hounsfield,
                     calibration::OutputFile& file);
void writeSolid(const VolumeGrid& grid, const std::vector<std::uint8_t>& solid, calibration::OutputFile& file);
/// Distances along the ray in mm, first row on top, 0 where nothing is hit: a 2-D NRRD of floats.
void writeDepth(int width_px, int height_px, const std::vector<float>& depth_mm, calibration::OutputFile& file);

}  // namespace assets
