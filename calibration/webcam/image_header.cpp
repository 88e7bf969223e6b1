#include "calibration/webcam/image_header.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <zlib.h>

namespace calibration {
namespace {

using Bytes = std::span<const std::uint8_t>;

std::uint32_t bigEndian(Bytes bytes, std::size_t at, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < count; ++i) value = value << 8 | bytes[at + i];
  return value;
}

std::optional<glm::ivec2> sizeFrom(std::uint32_t across, std::uint32_t down) {
  constexpr std::uint32_t kMost = 1U << 30;
  if (across == 0 || down == 0 || across > kMost || down > kMost) return std::nullopt;
  return glm::ivec2(across, down);
}

/// Chunk by chunk to IEND, their checksums too; the size is in the first, IHDR.
std::optional<glm::ivec2> sizeOfPng(Bytes file) {
  constexpr std::size_t kFrame = 12;  // length, name, checksum
  std::optional<glm::ivec2> size;
  for (std::size_t at = 8; at + kFrame <= file.size();) {
    const std::size_t length = bigEndian(file, at, 4);
    if (length > file.size() - at - kFrame) return std::nullopt;
    if (crc32_z(0, &file[at + 4], 4 + length) != bigEndian(file, at + 8 + length, 4)) return std::nullopt;
    const std::string_view name(reinterpret_cast<const char*>(&file[at + 4]), 4);
    if (!size) {
      if (name != "IHDR" || length != 13) return std::nullopt;
      size = sizeFrom(bigEndian(file, at + 8, 4), bigEndian(file, at + 12, 4));
      if (!size) return std::nullopt;
    }
    if (name == "IEND") return size;
    at += kFrame + length;
  }
  return std::nullopt;
}

/// Segment by segment to the scan, past a frame header, which holds the size; then the end's marker must come.
std::optional<glm::ivec2> sizeOfJpeg(Bytes file) {
  std::optional<glm::ivec2> size;
  for (std::size_t at = 2; at + 4 <= file.size();) {
    if (file[at] != 0xff) return std::nullopt;
    const int marker = file[at + 1];
    if (marker == 0xff) {  // filling
      ++at;
      continue;
    }
    const std::size_t length = bigEndian(file, at + 2, 2);
    if (length < 2 || length > file.size() - at - 2) return std::nullopt;
    const bool frame = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (frame) {
      if (size || length < 8) return std::nullopt;
      size = sizeFrom(bigEndian(file, at + 7, 2), bigEndian(file, at + 5, 2));
      if (!size) return std::nullopt;
    }
    at += 2 + length;
    if (marker != 0xda) continue;
    constexpr std::array<std::uint8_t, 2> kEnd{0xff, 0xd9};
    return std::ranges::search(file.subspan(at), kEnd).empty() ? std::nullopt : size;
  }
  return std::nullopt;
}

}  // namespace

std::optional<glm::ivec2> declaredSize_px(Bytes file) {
  constexpr std::array<std::uint8_t, 8> kPng{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  if (file.size() > kPng.size() && std::ranges::equal(file.first(kPng.size()), kPng)) return sizeOfPng(file);
  if (file.size() > 4 && file[0] == 0xff && file[1] == 0xd8) return sizeOfJpeg(file);
  return std::nullopt;
}

}  // namespace calibration
