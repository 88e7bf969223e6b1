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

/// Voxels of a file as integers of type `Value`; throws for the first that does not fit.
template <class Value>
class IntegerVoxels {
 public:
  IntegerVoxels(const ImageHeader& header, const char* advice) : header_(header), advice_(advice) {
    values_.reserve(header.voxelCount());
    forEachVoxelBlock(header, [this](std::span<const char> bytes) { append(bytes); });
  }

  std::vector<Value> take() { return std::move(values_); }

 private:
  void append(std::span<const char> bytes) {
    withVoxelType(header_.type, [&](auto stored) { appendStored<decltype(stored)>(bytes); });
  }

  template <class Stored>
  void appendStored(std::span<const char> bytes) {
    const bool is_reversed = header_.is_big_endian != (std::endian::native == std::endian::big);
    const bool is_rescaled = header_.isRescaled();
    for (std::size_t at = 0; at < bytes.size(); at += sizeof(Stored)) {
      std::array<char, sizeof(Stored)> raw;
      std::memcpy(raw.data(), bytes.data() + at, raw.size());
      if (is_reversed) std::reverse(raw.begin(), raw.end());
      const auto stored = std::bit_cast<Stored>(raw);
      values_.push_back(is_rescaled ? rounded(header_.slope * static_cast<double>(stored) + header_.intercept)
                                    : rounded(stored));
    }
  }

  template <class Number>
  Value rounded(Number number) const {
    if constexpr (std::is_floating_point_v<Number>) {
      if (!std::isfinite(number))
        refuseScan(header_.path, "it holds values that are not finite; export the volume again");
      const Number nearest = std::round(number);
      if (!(nearest >= static_cast<Number>(kMin) && nearest <= static_cast<Number>(kMax))) refuse(number);
      return static_cast<Value>(nearest);
    } else {
      if (!std::in_range<Value>(number)) refuse(number);
      return static_cast<Value>(number);
    }
  }

  template <class Number>
  [[noreturn]] void refuse(Number number) const {
    refuseScan(header_.path, "the value " + std::to_string(number) + " lies outside " + std::to_string(kMin) + ".." +
                                 std::to_string(kMax) + "; " + advice_);
  }

  static constexpr Value kMin = std::numeric_limits<Value>::min();
  static constexpr Value kMax = std::numeric_limits<Value>::max();
  const ImageHeader& header_;
  const char* advice_;
  std::vector<Value> values_;
};

/// A file with its header read; its voxels are not allocated yet.
class Scan {
 public:
  explicit Scan(const std::string& path) : header_(readImageHeader(path)), resampling_(header_.geometry, path) {
    requireDataLength(header_);
  }

  const Resampling& resampling() const { return resampling_; }
  bool orientationKnown() const { return header_.orientation_known; }

  template <class Value>
  std::vector<Value> values(const char* advice) const {
    try {
      return IntegerVoxels<Value>(header_, advice).take();
    } catch (const std::bad_alloc&) {
      refuseScan(header_.path, "there is not enough memory for it; crop it");
    }
  }

 private:
  ImageHeader header_;
  Resampling resampling_;
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
  std::vector<std::int16_t> values = scan.values<std::int16_t>("rescale it to Hounsfield");
  applyGreyWindow(values, window, path);
  return {scan.resampling().grid(), scan.resampling().linear(std::move(values), kAirHu), scan.orientationKnown()};
}

ByteImage readSolid(const std::string& path) {
  const Scan scan(path);
  return {scan.resampling().grid(),
          scan.resampling().linear(scan.values<std::uint8_t>("store solid as 0..255, or read it as hu"), 0)};
}

ByteImage readLabels(const std::string& path) {
  const Scan scan(path);
  return {scan.resampling().grid(), scan.resampling().nearest(scan.values<std::uint8_t>("store labels as 0..255"), 0)};
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
