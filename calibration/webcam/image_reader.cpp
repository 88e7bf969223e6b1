#include "calibration/webcam/image_reader.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <zlib.h>

#include "calibration/opencv_module.h"

namespace calibration {
namespace {

constexpr std::uintmax_t kLargestFile_bytes = 32 << 20;
constexpr int kSmallest_px = 16, kLargest_px = 16384;
constexpr std::int64_t kMaxPixels = std::int64_t{64} << 20;

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

/// Walks the chunks to IEND with their checksums; IHDR, the first, has the size.
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

/// Walks the segments to the scan; a frame header has the size; the end marker must follow.
std::optional<glm::ivec2> sizeOfJpeg(Bytes file) {
  std::optional<glm::ivec2> size;
  for (std::size_t at = 2; at + 4 <= file.size();) {
    if (file[at] != 0xff) return std::nullopt;
    const int marker = file[at + 1];
    if (marker == 0xff) {  // padding
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

/// Declared size, without decoding. None: not PNG or JPEG, truncated, or a wrong PNG checksum. 3 ms per megabyte of
/// PNG. Sources: PNG specification (W3C 2003) 5.3, 11.2; ITU-T T.81 B.2.
std::optional<glm::ivec2> declaredSize_px(Bytes file) {
  constexpr std::array<std::uint8_t, 8> kPng{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  if (file.size() > kPng.size() && std::ranges::equal(file.first(kPng.size()), kPng)) return sizeOfPng(file);
  if (file.size() > 4 && file[0] == 0xff && file[1] == 0xd8) return sizeOfJpeg(file);
  return std::nullopt;
}

}  // namespace

GreyImage readGreyImage(const std::string& path) {
  const auto refuse = [&](const char* what) {
    throw CalibrationError("image " + path + ": " + what + ", give a JPEG or PNG of the camera");
  };
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) refuse("it cannot be read");
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  if (error || bytes == 0 || bytes > kLargestFile_bytes) refuse("it is empty or has more than 32 MiB");
  std::vector<std::uint8_t> file(bytes);
  std::ifstream in(path, std::ios::binary);
  if (!in.read(reinterpret_cast<char*>(file.data()), static_cast<std::streamsize>(bytes))) refuse("it cannot be read");

  // Check the declared size first: a decoder would allocate it.
  const std::optional<glm::ivec2> size = declaredSize_px(file);
  if (!size) refuse("it is not a complete PNG or JPEG");
  if (size->x < kSmallest_px || size->y < kSmallest_px || size->x > kLargest_px || size->y > kLargest_px)
    refuse("a side of it is under 16 or beyond 16384 pixels");
  if (std::int64_t{size->x} * size->y > kMaxPixels) refuse("it has more than 64 megapixels");

  GreyImage image = openCvModule().decoded_grey(file);
  if (image.size_px != *size) refuse("it is damaged");
  return image;
}

}  // namespace calibration
