#include "assets/scan/voxel_bytes.h"

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "assets/scan/byte_source.h"
#include "assets/scan/compressed_bytes.h"
#include "assets/scan/header_text.h"
#include "assets/scan/regular_file.h"
#include "assets/scan/text_voxels.h"

namespace assets {

namespace {

constexpr double kMaxDeflateRatio = 1040.0;  // RFC 1951: at most 258 bytes in 2 bits

/// Start of the voxels in one data file, after the lines to skip.
std::uint64_t firstByte(const ImageHeader& header, const RegularFile& file, std::uint64_t from_byte) {
  if (header.skipped_lines == 0) return from_byte;
  CharacterReader characters(file, from_byte);
  std::uint64_t at = from_byte;
  for (std::int64_t lines = 0; lines < header.skipped_lines; ++at) {
    const auto c = characters.next();
    if (!c) refuseTruncated(file.path());
    lines += *c == '\n' ? 1 : 0;
  }
  return at;
}

std::uint64_t bytesInEachFile(const ImageHeader& header) {
  return header.voxelCount() / header.files.size() * bytesOf(header.type);
}

void skipBytes(ByteSource& source, std::int64_t count, const std::string& path) {
  std::vector<char> passed(static_cast<std::size_t>(std::min<std::int64_t>(count, kBlockBytes)));
  while (count > 0) {
    const auto step = static_cast<std::size_t>(std::min<std::int64_t>(count, kBlockBytes));
    if (source.fill(std::span(passed).first(step)) < step) refuseTruncated(path);
    count -= static_cast<std::int64_t>(step);
  }
}

/// Bytes of one data file, after everything that is skipped.
std::unique_ptr<ByteSource> sourceOf(const ImageHeader& header, const RegularFile& file, std::uint64_t from_byte) {
  const std::uint64_t first = firstByte(header, file, from_byte);
  const std::uint64_t bytes = bytesInEachFile(header);
  if (header.skipped_bytes == kVoxelsAtFileEnd) {
    if (header.coding != VoxelCoding::raw)
      refuseScan(file.path(), "a byte skip of -1 is not valid for compressed voxels; export the volume again");
    if (file.size() < first + bytes) refuseTruncated(file.path());
    return std::make_unique<RawSource>(file, file.size() - bytes);
  }

  // In compressed files the skip counts decompressed bytes.
  const bool is_compressed = header.coding == VoxelCoding::gzip;
  const auto skipped = static_cast<std::uint64_t>(header.skipped_bytes);
  if (!is_compressed && skipped > file.size()) refuseTruncated(file.path());
  const std::uint64_t start = is_compressed ? first : first + skipped;
  switch (header.coding) {
    case VoxelCoding::raw:
      return std::make_unique<RawSource>(file, start);
    case VoxelCoding::hex:
      return hexSource(file, start);
    case VoxelCoding::text:
      return textSource(header.type, file, start);
    case VoxelCoding::gzip:
      break;
  }
  auto bytes_after = decompressedSource(file, start);
  skipBytes(*bytes_after, header.skipped_bytes, file.path());
  return bytes_after;
}

/// Only raw voxels may be followed by a line end. Reading on also verifies the checksum of a compressed stream.
void refuseExtraBytes(ByteSource& source, VoxelCoding coding, const std::string& path) {
  const std::size_t line_end = coding == VoxelCoding::raw ? 2 : 0;
  std::array<char, 8> more{};
  const std::size_t got = source.fill(more);
  const auto is_line_end = [](char c) { return c == '\n' || c == '\r'; };
  if (got > line_end || !std::all_of(more.begin(), more.begin() + static_cast<std::ptrdiff_t>(got), is_line_end))
    refuseScan(path, "it holds more voxels than its header states; export the volume again");
}

}  // namespace

void requireDataLength(const ImageHeader& header) {
  const auto bytes = static_cast<double>(bytesInEachFile(header));
  for (const VoxelFile& each : header.files) {
    const RegularFile file(each.path);
    const auto held = static_cast<double>(file.size() - std::min(each.from_byte, file.size()));
    double needed = bytes;
    if (header.coding == VoxelCoding::gzip) needed = bytes / kMaxDeflateRatio;
    if (header.coding == VoxelCoding::hex) needed = 2.0 * bytes;
    if (header.coding == VoxelCoding::text) needed = 2.0 * bytes / static_cast<double>(bytesOf(header.type)) - 1.0;
    if (held < needed) refuseTruncated(each.path);
  }
}

void forEachVoxelBlock(const ImageHeader& header, const std::function<void(std::span<const char>)>& take) {
  std::vector<char> block(static_cast<std::size_t>(std::min<std::uint64_t>(bytesInEachFile(header), kBlockBytes)));
  for (const VoxelFile& each : header.files) {
    const RegularFile file(each.path);
    const auto source = sourceOf(header, file, each.from_byte);
    for (std::uint64_t left = bytesInEachFile(header); left > 0;) {
      const std::span<char> next =
          std::span(block).first(static_cast<std::size_t>(std::min<std::uint64_t>(left, kBlockBytes)));
      if (source->fill(next) < next.size()) refuseTruncated(each.path);
      take(next);
      left -= next.size();
    }
    if (header.skipped_bytes != kVoxelsAtFileEnd) refuseExtraBytes(*source, header.coding, each.path);
  }
}

}  // namespace assets
