#include "assets/import/dicom/codestream.h"

#include <cstdint>

namespace assets {
namespace {

std::uint32_t big(std::span<const char> bytes, std::size_t at, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t n = 0; n < count; ++n) value = value << 8 | static_cast<unsigned char>(bytes[at + n]);
  return value;
}

/// Segments up to the frame header.
std::optional<CodestreamFacts> jpegFacts(std::span<const char> stream) {
  constexpr std::uint32_t kStart = 0xffd8, kJpegLs = 0xf7;
  if (stream.size() < 4 || big(stream, 0, 2) != kStart) return std::nullopt;
  std::size_t at = 2;
  while (at + 9 < stream.size()) {
    if (big(stream, at, 1) != 0xff) return std::nullopt;
    const std::uint32_t marker = big(stream, at + 1, 1);
    if (marker == 0xff) {
      ++at;
      continue;
    }
    const bool is_frame =
        marker == kJpegLs || (marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc);
    if (is_frame)
      return CodestreamFacts{static_cast<int>(big(stream, at + 5, 2)), static_cast<int>(big(stream, at + 7, 2)),
                             static_cast<int>(big(stream, at + 4, 1)), static_cast<int>(big(stream, at + 9, 1))};
    at += 2 + big(stream, at + 2, 2);
  }
  return std::nullopt;
}

/// A bare codestream, or one in the boxes of a JP2 file.
std::optional<CodestreamFacts> jpeg2000Facts(std::span<const char> stream) {
  constexpr std::size_t kFarthest = 4096, kHead = 44;
  for (std::size_t at = 0; at + kHead <= stream.size() && at < kFarthest; ++at) {
    if (big(stream, at, 4) != 0xff4fff51) continue;
    const std::size_t size = at + 8;  // after SOC, SIZ, its length and the capabilities
    const std::uint32_t width = big(stream, size, 4) - big(stream, size + 8, 4);
    const std::uint32_t height = big(stream, size + 4, 4) - big(stream, size + 12, 4);
    if (width > 0xffff || height > 0xffff) return std::nullopt;
    const std::uint32_t depth = big(stream, size + 34, 1);
    return CodestreamFacts{static_cast<int>(height), static_cast<int>(width), static_cast<int>(depth & 0x7f) + 1,
                           static_cast<int>(big(stream, size + 32, 2)), (depth & 0x80) != 0};
  }
  return std::nullopt;
}

/// EOI or EOC, before bytes that pad the fragment.
bool endsWhole(std::span<const char> stream) {
  constexpr std::size_t kMostPadding = 3;
  for (std::size_t end = stream.size(); end >= 2 && stream.size() - end <= kMostPadding; --end)
    if (big(stream, end - 2, 2) == 0xffd9) return true;
  return false;
}

}  // namespace

std::optional<CodestreamFacts> codestreamFacts(PixelPacking packing, std::span<const char> stream) {
  std::optional<CodestreamFacts> facts;
  if (packing == PixelPacking::jpeg || packing == PixelPacking::jpeg_ls) facts = jpegFacts(stream);
  if (packing == PixelPacking::jpeg_2000) facts = jpeg2000Facts(stream);
  if (facts) facts->is_whole = endsWhole(stream);
  return facts;
}

}  // namespace assets
