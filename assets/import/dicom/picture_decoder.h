// Decodes one compressed picture through GDCM's codecs. They crash, hang and print on damaged streams, so this runs in
// a child process only (frame_reader.h); the stream's head is checked before. No exception leaves it.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "assets/import/dicom/codestream.h"

namespace assets {

/// Fills `out`, a value a pixel, as stored. False: the stream cannot be decoded.
bool decodePicture(std::string_view syntax_uid, const CodestreamFacts& facts, std::span<const char> stream,
                   std::span<std::uint16_t> out) noexcept;

}  // namespace assets
