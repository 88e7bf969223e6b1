// What a compressed picture says of itself, read from its markers before a decoder sees it: JPEG and JPEG-LS (SOF,
// ITU-T T.81 B.2.2, T.87), JPEG 2000 (SIZ, T.800 A.5.1). Any thread.
#pragma once

#include <optional>
#include <span>

#include "assets/import/dicom/transfer_syntax.h"

namespace assets {

struct CodestreamFacts {
  int rows = 0, columns = 0;
  int bits = 0;
  int components = 0;
  bool is_signed = false;  ///< JPEG 2000 alone says so
  bool is_whole = false;   ///< it ends with the mark of an end
};

/// None: not a stream of that packing, or its head is damaged.
std::optional<CodestreamFacts> codestreamFacts(PixelPacking packing, std::span<const char> stream);

}  // namespace assets
