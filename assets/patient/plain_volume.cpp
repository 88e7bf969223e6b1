#include "assets/patient/plain_volume.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <span>

#include "assets/load_error.h"
#include "assets/scan/regular_file.h"
#include "assets/tooth.h"
#include "calibration/output_file.h"

namespace assets {
namespace {

constexpr std::array<char, 8> kPlainMark = {'M', 'O', 'L', 'A', 'R', 'P', 'L', 'V'};
constexpr int kMostAlong = 4096;
constexpr std::size_t kMostVoxels = std::size_t{1} << 30;

struct PlainHead {
  std::array<char, 8> mark = kPlainMark;
  std::uint64_t checksum = 0;  ///< CRC-32 of the rest of the head and of the values
  std::array<std::int32_t, 3> size{};
  std::int32_t has_teeth = 0;
  double spacing_mm = 0.0;
  std::array<double, 3> origin_P_mm{};
};
static_assert(sizeof(PlainHead) == 64 && std::endian::native == std::endian::little);
constexpr std::size_t kUnchecked_bytes = 16;

std::uint64_t checksumOf(const PlainHead& head, const CtVolume& volume) {
  uLong crc = ::crc32_z(0, nullptr, 0);
  const auto add = [&](std::span<const std::byte> bytes) {
    crc = ::crc32_z(crc, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  };
  add(std::as_bytes(std::span(&head, 1)).subspan(kUnchecked_bytes));
  add(std::as_bytes(std::span(volume.hounsfield)));
  for (const auto* values : {&volume.label, &volume.solid, &volume.tooth})
    if (!values->empty()) add(std::as_bytes(std::span(*values)));
  return crc;
}

[[noreturn]] void refuse(const std::string& path, const std::string& what) {
  throw LoadError(path + ": " + what + "; delete it, it is made again");
}

VolumeGrid gridOf(const PlainHead& head, const std::string& path) {
  const VolumeGrid grid{{head.size[0], head.size[1], head.size[2]},
                        head.spacing_mm,
                        {head.origin_P_mm[0], head.origin_P_mm[1], head.origin_P_mm[2]}};
  for (int axis = 0; axis < 3; ++axis) {
    if (grid.size[axis] < 1 || grid.size[axis] > kMostAlong) refuse(path, "its size is out of range");
    if (!(std::abs(grid.origin_P_mm[axis]) < 1e5)) refuse(path, "its place is out of range");
  }
  if (grid.voxelCount() > kMostVoxels) refuse(path, "its size is out of range");
  if (!(grid.spacing_mm > 0.01 && grid.spacing_mm < 100.0)) refuse(path, "its voxels are out of range");
  return grid;
}

}  // namespace

void writePlainVolume(const CtVolume& volume, const std::string& path) {
  PlainHead head{.has_teeth = volume.tooth.empty() ? 0 : 1, .spacing_mm = volume.grid.spacing_mm};
  for (int axis = 0; axis < 3; ++axis) {
    head.size[static_cast<std::size_t>(axis)] = volume.grid.size[axis];
    head.origin_P_mm[static_cast<std::size_t>(axis)] = volume.grid.origin_P_mm[axis];
  }
  head.checksum = checksumOf(head, volume);
  std::string bytes;
  bytes.reserve(sizeof head + 5 * volume.grid.voxelCount());
  const auto add = [&](const auto& values) {
    const auto raw = std::as_bytes(std::span(values));
    bytes.append(reinterpret_cast<const char*>(raw.data()), raw.size());
  };
  add(std::span(&head, 1)), add(volume.hounsfield), add(volume.label), add(volume.solid), add(volume.tooth);
  calibration::OutputFile(path, true).commit(bytes);
}

CtVolume readPlainVolume(const std::string& path) {
  const RegularFile file(path);
  std::uint64_t from_byte = 0;
  const auto read = [&](auto* values, std::size_t count) {
    const std::span<char> bytes(reinterpret_cast<char*>(values), count * sizeof *values);
    if (file.readAt(from_byte, bytes) != bytes.size()) refuse(path, "it is cut short");
    from_byte += bytes.size();
  };
  PlainHead head;
  read(&head, 1);
  if (head.mark != kPlainMark) refuse(path, "it is no volume of this program");
  CtVolume volume;
  volume.grid = gridOf(head, path);
  const std::size_t voxels = volume.grid.voxelCount();
  if (file.size() != sizeof head + (head.has_teeth != 0 ? 5 : 4) * voxels) refuse(path, "it is cut short");
  const auto read_into = [&](auto& values) {
    values.resize(voxels);
    read(values.data(), voxels);
  };
  read_into(volume.hounsfield), read_into(volume.label), read_into(volume.solid);
  if (head.has_teeth != 0) read_into(volume.tooth);
  if (head.checksum != checksumOf(head, volume)) refuse(path, "it is damaged");

  std::array<bool, 256> is_tooth_number{};
  for (int fdi = 0; fdi < 256; ++fdi) is_tooth_number[static_cast<std::size_t>(fdi)] = fdi == 0 || isToothNumber(fdi);
  if (std::ranges::any_of(volume.label, [](std::uint8_t label) { return label >= kScanTissueCount; }) ||
      !std::ranges::all_of(volume.tooth, [&](std::uint8_t fdi) { return is_tooth_number[fdi]; }))
    refuse(path, "a value is out of range");
  return volume;
}

}  // namespace assets
