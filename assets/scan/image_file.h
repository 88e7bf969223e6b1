// Volumes as image files. Reads NRRD (.nrrd .nhdr), NIfTI (.nii .nii.gz) and MetaImage (.mha .mhd), any axis order,
// flips, oblique axes, RAS or LPS space, non-cubic voxels: what comes out is a VolumeGrid in P (LPS mm), see
// resampling.h. Any integer or float scalar type whose values fit, rescaled if the file says so. Writes gzip NRRD, LPS,
// i fastest (design: "Volume"). Every refusal is a LoadError of one line: what image_header.h and voxel_bytes.h refuse,
// values that are not finite or out of range, no or absurd geometry, too many voxels (kMaxVoxels). The header is judged
// first, then the files' lengths, then the voxels are read; no library sees a stranger's bytes but zlib. Any thread.
// Cost: about a second per 10^8 voxels, mostly unpacking. Not DICOM (a folder of slices has its own import).
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
  bool orientation_known = true;  ///< the file says which way its axes lie; if not they are taken for LPS
};

/// One byte a voxel: solid fraction or labels.
struct ByteImage {
  VolumeGrid grid;
  std::vector<std::uint8_t> values;
};

inline constexpr std::int16_t kAirHu = -1000;

/// Interpolated linearly where it must be; air outside. 8-bit greys are refused without a window.
HounsfieldImage readHounsfield(const std::string& path, const std::optional<GreyWindow>& window = std::nullopt);
/// Values 0..255; interpolated linearly where it must be; 0 outside.
ByteImage readSolid(const std::string& path);
/// Whole numbers 0..255; nearest voxel where it must be; 0 outside.
ByteImage readLabels(const std::string& path);

/// Two grids are one: same size, and no voxel centre differs by more than a hundredth of a voxel.
bool isSameGrid(const VolumeGrid& a, const VolumeGrid& b);

/// An calibration::OutputFile for the writers below; refuses a name that does not end in .nrrd.
calibration::OutputFile nrrdOutput(const std::string& path, bool overwrite);

/// The writers fill `file` and commit it.
void writeHounsfield(const VolumeGrid& grid, const std::vector<std::int16_t>& hounsfield,
                     calibration::OutputFile& file);
void writeSolid(const VolumeGrid& grid, const std::vector<std::uint8_t>& solid, calibration::OutputFile& file);
/// A picture of distances along the ray in mm, first row on top, 0 where nothing is hit: a 2-D NRRD of floats.
void writeDepth(int width_px, int height_px, const std::vector<float>& depth_mm, calibration::OutputFile& file);

}  // namespace assets
