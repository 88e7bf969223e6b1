#include "assets/patient/structure_file.h"

#include <zlib.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "assets/load_error.h"
#include "assets/scan/regular_file.h"
#include "calibration/output_file.h"

namespace assets {
namespace {

constexpr std::array<char, 8> kStructureMark = {'M', 'O', 'L', 'A', 'R', 'S', 'T', 'R'};
constexpr std::uint64_t kMostFile_bytes = std::uint64_t{1} << 29;

struct StructuresHead {
  std::array<char, 8> mark = kStructureMark;
  std::uint64_t checksum = 0;  ///< CRC-32 of all that follows
  std::uint64_t fingerprint = 0, count = 0;
};
struct StructureHead {
  std::array<std::int32_t, 3> size{};
  std::int32_t unused = 0;
  double spacing_mm = 0.0;
  std::array<double, 3> origin_P_mm{};
  std::uint64_t values = 0, points = 0, clusters = 0, groups = 0;
};
static_assert(sizeof(StructuresHead) == 32 && sizeof(StructureHead) == 80);
static_assert(sizeof(glm::vec3) == 12 && sizeof(StructureDistance::Cluster) == 24);
static_assert(std::endian::native == std::endian::little);
constexpr std::size_t kUnsummed_bytes = 16;

std::uint64_t sumOf(std::span<const char> bytes) {
  return ::crc32_z(::crc32_z(0, nullptr, 0), reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
}

[[noreturn]] void refuseFile(const std::string& path, const std::string& what) {
  throw LoadError(path + ": " + what + "; delete it, it is made again");
}

/// Takes values off the front of a file's bytes.
class Taker {
 public:
  Taker(std::span<const char> bytes, const std::string& path) : bytes_(bytes), path_(path) {}

  template <class Value>
  void take(Value* values, std::size_t count) {
    if (count > bytes_.size() / sizeof(Value)) refuseFile(path_, "it is cut short");
    if (count > 0) std::memcpy(static_cast<void*>(values), bytes_.data(), count * sizeof(Value));
    bytes_ = bytes_.subspan(count * sizeof(Value));
  }
  template <class Value>
  void takeInto(std::vector<Value>& values, std::uint64_t count) {
    if (count > bytes_.size() / sizeof(Value)) refuseFile(path_, "it is cut short");
    values.resize(count);
    take(values.data(), values.size());
  }
  bool isAtEnd() const { return bytes_.empty(); }

 private:
  std::span<const char> bytes_;
  const std::string& path_;
};

/// Parts in order, all of them.
bool areSound(const std::vector<StructureDistance::Cluster>& clusters, std::size_t parts) {
  std::uint32_t next = 0;
  for (const StructureDistance::Cluster& cluster : clusters) {
    if (cluster.first != next || cluster.end <= cluster.first || !(cluster.radius_mm >= 0.0F)) return false;
    next = cluster.end;
  }
  return next == parts;
}

bool isSound(const StructureDistance& one) {
  const VolumeGrid& grid = one.grid;
  for (int axis = 0; axis < 3; ++axis)
    if (grid.size[axis] < 0 || grid.size[axis] > 4096 || !(std::abs(grid.origin_P_mm[axis]) < 1e5)) return false;
  if (!(grid.spacing_mm > 0.01 && grid.spacing_mm < 100.0) && !one.isEmpty()) return false;
  return grid.voxelCount() == one.distance.size() && areSound(one.clusters, one.surface_P_mm.size()) &&
         areSound(one.groups, one.clusters.size());
}

}  // namespace

void writeStructures(std::span<const StructureDistance> structures, std::uint64_t fingerprint,
                     const std::string& path) {
  std::string bytes;
  const auto add = [&](const auto& values) {
    const auto raw = std::as_bytes(std::span(values));
    bytes.append(reinterpret_cast<const char*>(raw.data()), raw.size());
  };
  StructuresHead head{.fingerprint = fingerprint, .count = structures.size()};
  add(std::span(&head, 1));
  for (const StructureDistance& one : structures) {
    const glm::dvec3& origin = one.grid.origin_P_mm;
    const StructureHead about{{one.grid.size.x, one.grid.size.y, one.grid.size.z},
                              0,
                              one.grid.spacing_mm,
                              {origin.x, origin.y, origin.z},
                              one.distance.size(),
                              one.surface_P_mm.size(),
                              one.clusters.size(),
                              one.groups.size()};
    add(std::span(&about, 1)), add(one.distance), add(one.surface_P_mm), add(one.clusters), add(one.groups);
  }
  head.checksum = sumOf(std::span(bytes).subspan(kUnsummed_bytes));
  std::memcpy(bytes.data(), &head, sizeof head);
  calibration::OutputFile(path, true).commit(bytes);
}

std::vector<StructureDistance> readStructures(const std::string& path, std::uint64_t fingerprint, std::size_t count) {
  const RegularFile file(path);
  if (file.size() < sizeof(StructuresHead) || file.size() > kMostFile_bytes) refuseFile(path, "it has no distances");
  std::string bytes(file.size(), '\0');
  if (file.readAt(0, bytes) != bytes.size()) refuseFile(path, "it is cut short");
  Taker taker(bytes, path);
  StructuresHead head;
  taker.take(&head, 1);
  if (head.mark != kStructureMark) refuseFile(path, "it has no distances of this program");
  if (head.checksum != sumOf(std::span(bytes).subspan(kUnsummed_bytes))) refuseFile(path, "it is damaged");
  if (head.fingerprint != fingerprint || head.count != count) refuseFile(path, "it is of another patient");
  std::vector<StructureDistance> structures(count);
  for (StructureDistance& one : structures) {
    StructureHead about;
    taker.take(&about, 1);
    one.grid = {{about.size[0], about.size[1], about.size[2]},
                about.spacing_mm,
                {about.origin_P_mm[0], about.origin_P_mm[1], about.origin_P_mm[2]}};
    taker.takeInto(one.distance, about.values);
    taker.takeInto(one.surface_P_mm, about.points);
    taker.takeInto(one.clusters, about.clusters);
    taker.takeInto(one.groups, about.groups);
    if (!isSound(one)) refuseFile(path, "a value is out of range");
  }
  if (!taker.isAtEnd()) refuseFile(path, "it is too long");
  return structures;
}

}  // namespace assets
