#include "assets/import/dicom/stored_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace assets {
namespace {

/// Whether a compressed picture begins there: SOI of JPEG and JPEG-LS, SOC of JPEG 2000.
bool beginsPicture(const DicomBytes& bytes, const DicomFragment& part) {
  const std::uint32_t mark = integerAt(bytes, part.at, 2, true);
  return part.length >= 2 && (mark == 0xffd8 || mark == 0xff4f);
}

/// Fragments of one frame: all of them for a single frame, one each where the numbers agree, else by the table of
/// offsets, else from the mark at a picture's beginning to the next one.
std::vector<DicomFragment> fragmentsOf(const DicomBytes& bytes, const DicomHeader& header, std::size_t frame) {
  const std::span<const DicomFragment> parts = std::span(header.fragments).subspan(1);
  const auto frames = static_cast<std::size_t>(header.frames);
  if (frames == 1) return {parts.begin(), parts.end()};
  if (parts.size() == frames) return {parts[frame]};
  const DicomFragment& table = header.fragments.front();
  if (table.length != 4 * frames) {
    std::vector<DicomFragment> own;
    std::size_t begun = 0;
    for (const DicomFragment& part : parts) {
      begun += beginsPicture(bytes, part) ? 1 : 0;
      if (begun == frame + 1) own.push_back(part);
    }
    return begun == frames ? own : std::vector<DicomFragment>();
  }
  const auto offset = [&](std::size_t n) {
    return header.fragments[1].at - 8 + integerAt(bytes, table.at + 4 * n, 4, header.is_big_endian);
  };
  const std::uint64_t begin = offset(frame);
  const std::uint64_t end = frame + 1 < frames ? offset(frame + 1) : std::numeric_limits<std::uint64_t>::max();
  std::vector<DicomFragment> own;
  for (const DicomFragment& part : parts)
    if (part.at - 8 >= begin && part.at - 8 < end) own.push_back(part);
  return own;
}

/// PackBits of one segment into every `stride`th byte.
bool unpackRun(std::string_view packed, std::span<char> out, std::size_t first, std::size_t stride) {
  std::size_t at = 0, to = first;
  while (to < out.size()) {
    if (at >= packed.size()) return false;
    const int head = static_cast<signed char>(packed[at++]);
    if (head == -128) continue;
    const std::size_t count = static_cast<std::size_t>(head >= 0 ? head + 1 : 1 - head);
    const std::size_t taken = head >= 0 ? count : 1;
    if (taken > packed.size() - at) return false;
    for (std::size_t n = 0; n < count && to < out.size(); ++n, to += stride) out[to] = packed[at + (head >= 0 ? n : 0)];
    at += taken;
  }
  return true;
}

/// Little endian bytes of the pixels; empty: damaged.
std::string unpackedRuns(const std::string& packed, std::size_t pixels, std::size_t bytes_per_pixel) {
  constexpr std::size_t kHead = 64;
  const DicomBytes bytes = DicomBytes::ofMemory(packed);
  if (packed.size() < kHead || integerAt(bytes, 0, 4, false) != bytes_per_pixel) return {};
  std::string plain(pixels * bytes_per_pixel, '\0');
  for (std::size_t segment = 0; segment < bytes_per_pixel; ++segment) {
    const std::size_t begin = integerAt(bytes, 4 + 4 * segment, 4, false);
    const std::size_t end = segment + 1 < bytes_per_pixel ? integerAt(bytes, 8 + 4 * segment, 4, false) : packed.size();
    if (begin < kHead || begin > end || end > packed.size()) return {};
    // The most significant byte comes first.
    if (!unpackRun(std::string_view(packed).substr(begin, end - begin), plain, bytes_per_pixel - 1 - segment,
                   bytes_per_pixel))
      return {};
  }
  return plain;
}

}  // namespace

std::string frameBytesOf(const DicomBytes& bytes, const DicomHeader& header, std::size_t frame) {
  std::string whole;
  if (header.syntax->packing == PixelPacking::plain) {
    whole.resize(header.frameBytes());
    if (!bytes.read(header.pixels_at + frame * header.frameBytes(), whole)) whole.clear();
    return whole;
  }
  if (header.fragments.size() < 2) return {};
  for (const DicomFragment& part : fragmentsOf(bytes, header, frame)) {
    const std::size_t before = whole.size();
    if (part.length > bytes.size() || before + part.length > std::numeric_limits<std::uint32_t>::max()) return {};
    whole.resize(before + part.length);
    if (!bytes.read(part.at, std::span(whole).subspan(before))) return {};
  }
  return whole;
}

std::vector<std::uint16_t> storedValues(const DicomHeader& header, const std::string& frame_bytes) {
  const std::size_t pixels = header.pixelCount();
  const auto bytes_per_pixel = static_cast<std::size_t>(header.format.bits_allocated / 8);
  const bool is_packed = header.syntax->packing == PixelPacking::run_length;
  const std::string unpacked = is_packed ? unpackedRuns(frame_bytes, pixels, bytes_per_pixel) : std::string();
  const std::string& plain = is_packed ? unpacked : frame_bytes;
  if (plain.size() != pixels * bytes_per_pixel) return {};
  std::vector<std::uint16_t> stored(pixels);
  const bool is_big = header.is_big_endian && !is_packed;
  for (std::size_t n = 0; n < pixels; ++n) {
    if (bytes_per_pixel == 1) {
      stored[n] = static_cast<unsigned char>(plain[n]);
      continue;
    }
    const auto first = static_cast<unsigned char>(plain[2 * n]), second = static_cast<unsigned char>(plain[2 * n + 1]);
    stored[n] = static_cast<std::uint16_t>(is_big ? first << 8 | second : second << 8 | first);
  }
  return stored;
}

DicomPixelFormat formatOf(const DicomHeader& header, const std::optional<bool>& stream_is_signed, int stream_bits) {
  DicomPixelFormat format = header.format;
  if (stream_is_signed && *stream_is_signed != format.is_signed) {
    format.is_signed = *stream_is_signed;
    format.bits_stored = stream_bits;
    format.high_bit = stream_bits - 1;
  }
  return format;
}

void greyFromStored(std::span<const std::uint16_t> stored, const DicomPixelFormat& format, double slope,
                    double intercept, std::span<std::int16_t> grey) {
  const int shift = format.high_bit + 1 - format.bits_stored;
  const std::uint32_t mask = format.bits_stored >= 16 ? 0xffffU : (1U << format.bits_stored) - 1;
  const std::uint32_t sign = 1U << (format.bits_stored - 1);
  const auto value_of = [&](std::uint32_t pattern) {
    const std::uint32_t bits = pattern >> shift & mask;
    return static_cast<int>(bits) - (format.is_signed && (bits & sign) != 0 ? static_cast<int>(mask) + 1 : 0);
  };
  const int inverted = format.is_signed ? -1 : static_cast<int>(mask);  // highest and lowest value together
  int padding_low = 1, padding_high = 0;
  // One that no pixel can have says nothing: its upper bits are neither zero nor the sign.
  const auto fits = [&](std::uint32_t pattern) {
    const std::uint32_t upper = pattern & 0xffffU & ~mask;
    return upper == 0 || (format.is_signed && upper == (0xffffU & ~mask) && (pattern & sign) != 0);
  };
  if (format.padding && fits(*format.padding) && fits(format.padding_limit.value_or(*format.padding))) {
    const int one = value_of(*format.padding << shift),
              other = value_of(format.padding_limit.value_or(*format.padding) << shift);
    padding_low = std::min(one, other), padding_high = std::max(one, other);
  }
  constexpr double kLowest = kNoGrey + 1, kHighest = std::numeric_limits<std::int16_t>::max();
  for (std::size_t n = 0; n < stored.size(); ++n) {
    const int value = value_of(stored[n]);
    if (value >= padding_low && value <= padding_high) {
      grey[n] = kNoGrey;
      continue;
    }
    const double scaled = slope * (format.is_inverted ? inverted - value : value) + intercept;
    grey[n] = static_cast<std::int16_t>(std::floor(std::clamp(scaled, kLowest, kHighest) + 0.5));
  }
}

}  // namespace assets
