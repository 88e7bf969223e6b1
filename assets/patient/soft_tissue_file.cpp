#include "assets/patient/soft_tissue_file.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <span>
#include <vector>

#include "assets/load_error.h"
#include "assets/scan/file_checksum.h"
#include "assets/scan/regular_file.h"
#include "assets/scenery/soft_tissue_distance.h"
#include "calibration/output_file.h"

namespace assets {
namespace {

constexpr std::array<char, 8> kSoftTissueMark = {'M', 'O', 'L', 'A', 'R', 'S', 'F', 'T'};
constexpr std::size_t kTrailer_bytes = 24;
constexpr int kMostAlong = 1024;
constexpr std::size_t kMostVoxels = std::size_t{1} << 25;
constexpr std::uint64_t kMost_bytes = 4 * kMostVoxels;
constexpr std::size_t kMostDeflated = 1040;  // times smaller: more than any zlib stream

struct SoftTissueHead {
  std::array<char, 8> mark = kSoftTissueMark;
  std::uint64_t fingerprint = 0;
  std::array<std::int32_t, 3> size{};
  std::int32_t unused = 0;
  double spacing_mm = 0.0;
  std::array<double, 3> origin_P_mm{};
};
static_assert(sizeof(SoftTissueHead) == 64 && std::endian::native == std::endian::little);

/// Multiply and rotate, 32 bits at a time: against accidents, not forgery.
class Fingerprint {
 public:
  void add(std::uint64_t word) { hash_ = std::rotl((hash_ ^ word) * 0x9e3779b97f4a7c15u, 29); }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(const std::string& text) {
    add(std::uint64_t{text.size()});
    for (const char c : text) add(std::uint64_t{static_cast<unsigned char>(c)});
  }
  void add(const MeshModel& model) {
    add(std::uint64_t{model.parts.size()});
    for (const MeshPart& part : model.parts) {
      add(part.name);
      add(static_cast<double>(part.material.metallic));
      add(std::uint64_t{part.position_mm.size()});
      for (const glm::vec3& p : part.position_mm) {
        add(std::uint64_t{std::bit_cast<std::uint32_t>(p.x)} << 32 | std::bit_cast<std::uint32_t>(p.y));
        add(std::uint64_t{std::bit_cast<std::uint32_t>(p.z)});
      }
      add(std::uint64_t{part.triangles.size()});
      for (const std::uint32_t corner : part.triangles) add(std::uint64_t{corner});
    }
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0x4d4f4c4152u;
};

[[noreturn]] void refuse(const std::string& path, const std::string& what) {
  throw LoadError(path + ": " + what + "; delete it, it is made again");
}

VolumeGrid gridOf(const SoftTissueHead& head, const std::string& path) {
  VolumeGrid grid;
  grid.size = {head.size[0], head.size[1], head.size[2]};
  grid.spacing_mm = head.spacing_mm;
  grid.origin_P_mm = {head.origin_P_mm[0], head.origin_P_mm[1], head.origin_P_mm[2]};
  const bool is_empty = grid.size == glm::ivec3(0);
  for (int axis = 0; axis < 3; ++axis) {
    if (!is_empty && (grid.size[axis] < 2 || grid.size[axis] > kMostAlong)) refuse(path, "its size is out of range");
    if (!(std::abs(grid.origin_P_mm[axis]) < 1e5)) refuse(path, "its place is out of range");
  }
  if (!is_empty && !(grid.spacing_mm > 0.01 && grid.spacing_mm < 100.0)) refuse(path, "its voxels are out of range");
  if (!is_empty && grid.voxelCount() > kMostVoxels) refuse(path, "its size is out of range");
  return grid;
}

}  // namespace

std::uint64_t softTissueFingerprint(const MeshModel& gingiva_P, const MeshModel& face_P,
                                    const SoftTissueRegion& region) {
  Fingerprint fingerprint;
  fingerprint.add(std::uint64_t{kSoftTissueRevision});
  for (int axis = 0; axis < 3; ++axis) fingerprint.add(region.centre_P_mm[axis]);
  fingerprint.add(region.reach_mm);
  fingerprint.add(gingiva_P);
  fingerprint.add(face_P);
  return fingerprint.value();
}

void writeSoftTissue(const SoftTissueField& field, std::uint64_t fingerprint, const std::string& path) {
  const std::size_t voxels = field.distance.size();
  SoftTissueHead head{.fingerprint = fingerprint, .spacing_mm = field.grid.spacing_mm};
  for (int axis = 0; axis < 3; ++axis) {
    head.size[static_cast<std::size_t>(axis)] = voxels > 0 ? field.grid.size[axis] : 0;
    head.origin_P_mm[static_cast<std::size_t>(axis)] = field.grid.origin_P_mm[axis];
  }
  std::vector<std::uint8_t> plain(3 * voxels);
  for (std::size_t v = 0; v < voxels; ++v) {
    const auto distance = static_cast<std::uint16_t>(field.distance[v]);
    plain[v] = static_cast<std::uint8_t>(distance & 0xff);
    plain[v + voxels] = static_cast<std::uint8_t>(distance >> 8);
    plain[v + 2 * voxels] = field.tissue[v];
  }
  uLongf packed_bytes = ::compressBound(plain.size());
  std::string bytes(sizeof head + packed_bytes, '\0');
  std::memcpy(bytes.data(), &head, sizeof head);
  if (::compress2(reinterpret_cast<Bytef*>(bytes.data() + sizeof head), &packed_bytes, plain.data(), plain.size(),
                  Z_BEST_SPEED) != Z_OK)
    throw LoadError(path + ": it cannot be packed; free some memory");
  bytes.resize(sizeof head + packed_bytes);

  calibration::OutputFile file(path, true);
  file.write(bytes);
  appendChecksum(file.temporaryPath());
  file.commit();
}

SoftTissueField readSoftTissue(const std::string& path, std::uint64_t fingerprint) {
  requireChecksum(path);
  const RegularFile file(path);
  if (file.size() < sizeof(SoftTissueHead) + kTrailer_bytes || file.size() > kMost_bytes)
    refuse(path, "it is no soft tissue");
  std::string bytes(file.size() - kTrailer_bytes, '\0');
  SoftTissueHead head;
  if (file.readAt(0, bytes) != bytes.size()) refuse(path, "it is cut short");
  std::memcpy(&head, bytes.data(), sizeof head);
  if (head.mark != kSoftTissueMark) refuse(path, "it is no soft tissue");
  if (head.fingerprint != fingerprint) refuse(path, "it is of another patient");

  SoftTissueField field;
  field.grid = gridOf(head, path);
  const std::size_t voxels = field.grid.size.x > 0 ? field.grid.voxelCount() : 0;
  const std::size_t packed_bytes = bytes.size() - sizeof head;
  if (3 * voxels > kMostDeflated * packed_bytes) refuse(path, "it is cut short");
  std::vector<std::uint8_t> plain(std::max<std::size_t>(3 * voxels, 1));
  uLongf plain_bytes = plain.size();
  if (::uncompress(plain.data(), &plain_bytes, reinterpret_cast<const Bytef*>(bytes.data() + sizeof head),
                   packed_bytes) != Z_OK ||
      plain_bytes != 3 * voxels)
    refuse(path, "it is damaged");

  constexpr auto kLeast = static_cast<std::int16_t>(-SoftTissueField::kPerMm * SoftTissueField::kInside_mm),
                 kMost = static_cast<std::int16_t>(SoftTissueField::kPerMm * SoftTissueField::kOutside_mm);
  field.distance.resize(voxels);
  field.tissue.assign(plain.begin() + static_cast<std::ptrdiff_t>(2 * voxels),
                      plain.begin() + static_cast<std::ptrdiff_t>(3 * voxels));
  for (std::size_t v = 0; v < voxels; ++v) {
    const auto distance = static_cast<std::int16_t>(static_cast<std::uint16_t>(plain[v] | plain[v + voxels] << 8));
    if (distance < kLeast || distance > kMost || field.tissue[v] >= kSoftTissueCount)
      refuse(path, "a value is out of range");
    field.distance[v] = distance;
  }
  return field;
}

}  // namespace assets
