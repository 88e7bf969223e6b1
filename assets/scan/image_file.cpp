#include "assets/scan/image_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include "assets/load_error.h"
#include "assets/scan/header_text.h"
#include "assets/scan/image_header.h"
#include "assets/scan/nrrd_write.h"
#include "assets/scan/resampling.h"
#include "assets/scan/voxel_bytes.h"
#include "assets/scan/voxel_type.h"

namespace assets {

namespace {

/// Voxels of a file as integers of type `Value`. Throws LoadError for the first that does not fit, with `advice`.
template <class Value>
std::vector<Value> voxelsOf(const ImageHeader& header, const char* advice) {
  constexpr Value kMin = std::numeric_limits<Value>::min(), kMax = std::numeric_limits<Value>::max();
  const auto rounded = [&](auto number) {
    if constexpr (std::is_floating_point_v<decltype(number)>) {
      if (!std::isfinite(number))
        refuseScan(header.path, "it holds values that are not finite; export the volume again");
      const auto nearest = std::round(number);
      if (nearest >= kMin && nearest <= kMax) return static_cast<Value>(nearest);
    } else {
      if (std::in_range<Value>(number)) return static_cast<Value>(number);
    }
    refuseScan(header.path, "the value " + std::to_string(number) + " lies outside " + std::to_string(kMin) + ".." +
                                std::to_string(kMax) + "; " + advice);
  };
  const bool is_reversed = header.is_big_endian != (std::endian::native == std::endian::big);
  const bool is_rescaled = header.isRescaled();
  std::vector<Value> values;
  const auto append = [&]<class Stored>(std::span<const char> bytes, Stored) {
    for (std::size_t at = 0; at < bytes.size(); at += sizeof(Stored)) {
      std::array<char, sizeof(Stored)> raw;
      std::memcpy(raw.data(), bytes.data() + at, raw.size());
      if (is_reversed) std::reverse(raw.begin(), raw.end());
      const auto stored = std::bit_cast<Stored>(raw);
      values.push_back(is_rescaled ? rounded(header.slope * static_cast<double>(stored) + header.intercept)
                                   : rounded(stored));
    }
  };
  try {
    values.reserve(header.voxelCount());
    forEachVoxelBlock(header, [&](std::span<const char> bytes) {
      withVoxelType(header.type, [&](auto zero) { append(bytes, zero); });
    });
    return values;
  } catch (const std::bad_alloc&) {
    refuseScan(header.path, "there is not enough memory for it; crop it");
  }
}

/// A file with its header read and its length checked; its voxels are not allocated yet.
struct Scan {
  explicit Scan(const std::string& path) : header(readImageHeader(path)), resampling(header.geometry, path) {
    requireDataLength(header);
  }

  ImageHeader header;
  Resampling resampling;
};

template <class Value>
NrrdArray arrayOf(const VolumeGrid& grid, VoxelType type, const std::vector<Value>& values) {
  assert(values.size() == grid.voxelCount());
  return {type,
          {grid.size.x, grid.size.y, grid.size.z},
          grid.spacing_mm,
          grid.origin_P_mm,
          std::as_bytes(std::span(values))};
}

}  // namespace

HounsfieldImage readHounsfield(const std::string& path, const std::optional<GreyWindow>& window) {
  const Scan scan(path);
  auto values = voxelsOf<std::int16_t>(scan.header, "rescale it to Hounsfield");
  applyGreyWindow(values, window, path);
  const glm::dmat3& step_P_mm = scan.header.geometry.step_P_mm;
  return {scan.resampling.grid(), scan.resampling.linear(std::move(values), kAirHu), scan.header.orientation_known,
          std::max({glm::length(step_P_mm[0]), glm::length(step_P_mm[1]), glm::length(step_P_mm[2])})};
}

ByteImage readSolid(const std::string& path) {
  const Scan scan(path);
  auto values = voxelsOf<std::uint8_t>(scan.header, "store solid as 0..255, or read it as hu");
  return {scan.resampling.grid(), scan.resampling.linear(std::move(values), 0)};
}

ByteImage readLabels(const std::string& path) {
  const Scan scan(path);
  auto values = voxelsOf<std::uint8_t>(scan.header, "store labels as 0..255");
  return {scan.resampling.grid(), scan.resampling.nearest(std::move(values), 0)};
}

bool isSameGrid(const VolumeGrid& a, const VolumeGrid& b) {
  if (a.size != b.size) return false;
  const double tolerance_mm = 0.01 * a.spacing_mm;
  const glm::dvec3 first_mm = glm::abs(a.origin_P_mm - b.origin_P_mm);
  const glm::dvec3 last_mm = glm::abs(a.centre_P_mm(a.size - 1) - b.centre_P_mm(b.size - 1));
  return std::max({first_mm.x, first_mm.y, first_mm.z, last_mm.x, last_mm.y, last_mm.z}) <= tolerance_mm;
}

calibration::OutputFile nrrdOutput(const std::string& path, bool overwrite) {
  if (!lowerCase(path).ends_with(".nrrd"))
    refuseScan(path, "volumes are written as NRRD; choose a name that ends in .nrrd");
  return calibration::OutputFile(path, overwrite);
}

void writeHounsfield(const VolumeGrid& grid, const std::vector<std::int16_t>& hounsfield,
                     calibration::OutputFile& file) {
  writeNrrd(arrayOf(grid, VoxelType::int16, hounsfield), file);
}

void writeSolid(const VolumeGrid& grid, const std::vector<std::uint8_t>& solid, calibration::OutputFile& file) {
  writeNrrd(arrayOf(grid, VoxelType::uint8, solid), file);
}

void writeDepth(int width_px, int height_px, const std::vector<float>& depth_mm, calibration::OutputFile& file) {
  assert(depth_mm.size() == static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px));
  writeNrrd({VoxelType::float32, {width_px, height_px}, 1.0, glm::dvec3(0.0), std::as_bytes(std::span(depth_mm))},
            file);
}

}  // namespace assets
