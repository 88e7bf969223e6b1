// Stored values of one frame, a 16-bit pattern a pixel: plain pixels in both byte orders and RLE (PS3.5 annex G) here,
// compressed ones through the decoder. And from patterns to grey values: bits outside the stored ones masked, sign,
// MONOCHROME1, padding, slope and intercept. Any thread; 1 ns a pixel.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "assets/import/dicom/dicom_header.h"

namespace assets {

/// The grey value of a pixel outside the picture (its stored value is the padding value).
inline constexpr std::int16_t kNoGrey = -32768;

/// Bytes of a frame as they lie in the file, its fragments joined; empty: they are not all there.
std::string frameBytesOf(const DicomBytes& bytes, const DicomHeader& header, std::size_t frame);

/// Of plain and RLE frames; empty: damaged.
std::vector<std::uint16_t> storedValues(const DicomHeader& header, const std::string& frame_bytes);

/// `format` is the header's, or what a compressed stream says of itself where it differs.
void greyFromStored(std::span<const std::uint16_t> stored, const DicomPixelFormat& format, double slope,
                    double intercept, std::span<std::int16_t> grey);

/// The header's format, in which a compressed stream's own sign is believed.
DicomPixelFormat formatOf(const DicomHeader& header, const std::optional<bool>& stream_is_signed, int stream_bits);

}  // namespace assets
