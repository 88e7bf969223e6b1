#include "assets/scan/nifti_header.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <set>

#include "assets/scan/compressed_bytes.h"
#include "assets/scan/header_text.h"

namespace assets {

namespace {

constexpr std::size_t kHeaderBytes = 348;

// Byte offsets of the fields, nifti1.h.
enum At : std::size_t {
  at_dim = 40,
  at_datatype = 70,
  at_pixdim = 76,
  at_vox_offset = 108,
  at_slope = 112,
  at_inter = 116,
  at_units = 123,
  at_qform_code = 252,
  at_sform_code = 254,
  at_quatern = 256,
  at_qoffset = 268,
  at_srow = 280,
  at_magic = 344
};

class NiftiHeader {
 public:
  explicit NiftiHeader(const RegularFile& file) : path_(file.path()) {
    is_compressed_ = isGzip(file);
    bytes_ = is_compressed_ ? firstDecompressedBytes(file, kHeaderBytes) : std::string(kHeaderBytes, '\0');
    if (!is_compressed_) bytes_.resize(file.readAt(0, bytes_));
    checkFormat();
  }

  ImageHeader header() const {
    ImageHeader header;
    header.path = path_;
    header.coding = is_compressed_ ? VoxelCoding::gzip : VoxelCoding::raw;
    header.is_big_endian = is_big_endian_;
    header.type = type();
    header.geometry = geometry();
    readRescale(header);
    header.files = {{path_, 0}};
    header.skipped_bytes = voxelOffset();
    return header;
  }

 private:
  template <class Number>
  Number number(std::size_t at) const {
    std::array<char, sizeof(Number)> raw;
    std::memcpy(raw.data(), bytes_.data() + at, raw.size());
    if (is_big_endian_ != (std::endian::native == std::endian::big)) std::reverse(raw.begin(), raw.end());
    return std::bit_cast<Number>(raw);
  }
  int integer(std::size_t at) const { return number<std::int16_t>(at); }
  double real(std::size_t at) const { return number<float>(at); }
  double real(std::size_t at, int index) const { return real(at + 4 * static_cast<std::size_t>(index)); }

  void checkFormat() {
    const auto is_header_of = [&](std::int32_t size) {
      is_big_endian_ = false;
      if (bytes_.size() >= 4 && number<std::int32_t>(0) == size) return true;
      is_big_endian_ = true;
      return bytes_.size() >= 4 && number<std::int32_t>(0) == size;
    };
    constexpr std::int32_t kNifti2 = 540;
    if (is_header_of(kNifti2)) refuseScan(path_, "it is a NIfTI-2 file; export it as NIfTI-1");
    if (!is_header_of(kHeaderBytes) || bytes_.size() < kHeaderBytes)
      refuseScan(path_, "it is not a NIfTI-1 file; export it as NIfTI-1");
    const std::string magic = bytes_.substr(at_magic, 4);
    if (magic == std::string("ni1\0", 4)) refuseScan(path_, "its voxels lie in an .img file; export it as one .nii");
    if (magic != std::string("n+1\0", 4)) refuseScan(path_, "it is not a NIfTI-1 file; export it as NIfTI-1");
  }

  VoxelType type() const {
    static const std::map<int, VoxelType> kTypes = {
        {2, VoxelType::uint8},    {4, VoxelType::int16},    {8, VoxelType::int32},    {16, VoxelType::float32},
        {64, VoxelType::float64}, {256, VoxelType::int8},   {512, VoxelType::uint16}, {768, VoxelType::uint32},
        {1024, VoxelType::int64}, {1280, VoxelType::uint64}};
    static const std::set<int> kSeveralValues = {32, 128, 1792, 2048, 2304};
    const int code = integer(at_datatype);
    if (kSeveralValues.contains(code)) refuseSeveralValues(path_);
    const auto found = kTypes.find(code);
    if (found == kTypes.end()) refuseScan(path_, "its voxels are of an unsupported type; store integers or floats");
    return found->second;
  }

  double millimetresPerUnit() const {
    static const std::map<int, double> kUnits = {{0, 1.0}, {1, 1.0e3}, {2, 1.0}, {3, 1.0e-3}};
    const auto found = kUnits.find(bytes_[at_units] & 7);
    if (found == kUnits.end()) refuseScan(path_, "its unit of length is unknown; export it in mm");
    return found->second;
  }

  ScanGeometry geometry() const {
    ScanGeometry result;
    const int axes = integer(at_dim);
    bool is_volume = axes >= 3 && axes <= 7;
    for (int d = 1; is_volume && d <= axes; ++d) {
      const int size = integer(at_dim + 2 * static_cast<std::size_t>(d));
      is_volume = d <= 3 ? size >= 1 : size == 1;
      if (d <= 3) result.size[d - 1] = size;
    }
    if (!is_volume) refuseScan(path_, "it has not three axes; give a volume");

    glm::dvec3 spacing;
    for (int a = 0; a < 3; ++a) {
      spacing[a] = real(at_pixdim, a + 1);
      if (!(spacing[a] > 0.0) || !std::isfinite(spacing[a]))
        refuseScan(path_, std::string("its voxel sizes (pixdim) are not all positive and finite") + kExportAgain);
    }
    if (integer(at_sform_code) > 0)
      geometryFromSform(spacing, result);
    else if (integer(at_qform_code) > 0)
      geometryFromQform(spacing, result);
    else
      refuseScan(path_, "it states no orientation (qform and sform codes are 0); export it with orientation");

    // From RAS to LPS, from the file's unit to mm.
    const glm::dvec3 mm = millimetresPerUnit() * glm::dvec3(-1.0, -1.0, 1.0);
    for (int a = 0; a < 3; ++a) result.step_P_mm[a] *= mm;
    result.origin_P_mm *= mm;
    return result;
  }

  void geometryFromSform(const glm::dvec3& spacing, ScanGeometry& result) const {
    for (int p = 0; p < 3; ++p) {
      for (int a = 0; a < 3; ++a) result.step_P_mm[a][p] = real(at_srow, 4 * p + a);
      result.origin_P_mm[p] = real(at_srow, 4 * p + 3);
    }
    constexpr double kAgree = 0.01;
    constexpr double kShear = 1.0e-3;
    for (int a = 0; a < 3; ++a) {
      const double length = glm::length(result.step_P_mm[a]);
      if (!std::isfinite(length))
        refuseScan(path_, std::string("its sform holds a value that is not finite") + kExportAgain);
      if (!(std::abs(length - spacing[a]) <= kAgree * spacing[a]))
        refuseScan(path_, std::string("its voxel sizes (pixdim) and its sform do not agree") + kExportAgain);
    }
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3;
      const double cosine = glm::dot(result.step_P_mm[a], result.step_P_mm[b]) / (spacing[a] * spacing[b]);
      if (!(std::abs(cosine) <= kShear))
        refuseScan(path_, "its sform is sheared; export it as NRRD, or with square axes");
    }
  }

  /// The rotation of the quaternion (a, b, c, d) with a >= 0; the third axis reversed if pixdim[0] is below 0.
  void geometryFromQform(const glm::dvec3& spacing, ScanGeometry& result) const {
    const glm::dvec3 bcd(real(at_quatern, 0), real(at_quatern, 1), real(at_quatern, 2));
    const double square = glm::dot(bcd, bcd);
    const double handed = real(at_pixdim);
    constexpr double kRounding = 1.0e-4;
    if (!(square <= 1.0 + kRounding) || !std::isfinite(handed))
      refuseScan(path_, std::string("its qform is not a rotation") + kExportAgain);
    const glm::dquat rotation = glm::normalize(glm::dquat(std::sqrt(std::max(1.0 - square, 0.0)), bcd.x, bcd.y, bcd.z));
    const glm::dmat3 axes = glm::mat3_cast(rotation);
    for (int a = 0; a < 3; ++a) {
      result.step_P_mm[a] = spacing[a] * axes[a];
      result.origin_P_mm[a] = real(at_qoffset, a);
    }
    if (handed < 0.0) result.step_P_mm[2] *= -1.0;
  }

  /// No rescale: a slope of 0, or a NaN, which some writers store for it.
  void readRescale(ImageHeader& header) const {
    const double slope = real(at_slope), intercept = real(at_inter);
    if (slope == 0.0 || (std::isnan(slope) && (std::isnan(intercept) || intercept == 0.0))) return;
    if (!std::isfinite(slope) || !std::isfinite(intercept))
      refuseScan(path_, std::string("its rescale (scl_slope, scl_inter) is not finite") + kExportAgain);
    header.slope = slope;
    header.intercept = intercept;
  }

  std::int64_t voxelOffset() const {
    constexpr double kFirst = 352.0;
    constexpr double kLast = 1.0e8;
    const double offset = real(at_vox_offset);
    if (offset == 0.0) return static_cast<std::int64_t>(kFirst);
    if (!(offset >= kHeaderBytes && offset <= kLast) || offset != std::floor(offset))
      refuseScan(path_, std::string("its voxel offset (vox_offset) is not valid") + kExportAgain);
    return static_cast<std::int64_t>(offset);
  }

  std::string path_;
  std::string bytes_;
  bool is_compressed_ = false;
  bool is_big_endian_ = false;
};

}  // namespace

ImageHeader readNiftiHeader(const RegularFile& file) { return NiftiHeader(file).header(); }

}  // namespace assets
