// Walks over the elements of a DICOM data set (PS3.5 chapter 7) up to its pixel data: explicit and implicit types, both
// byte orders, sequences of defined and undefined length, unknown types. Values are not read, only their positions
// told. Work is bounded: 2 million elements, sequences 12 deep. Any thread.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "assets/import/dicom/dicom_bytes.h"

namespace assets {

struct DicomCoding {
  bool is_implicit = false;
  bool is_big_endian = false;
};

inline constexpr std::uint32_t kUndefinedLength = 0xffffffff;

struct DicomElement {
  std::uint32_t tag = 0;       ///< group in the upper half
  std::array<char, 2> type{};  ///< VR; zero where the coding has none
  std::uint64_t at = 0;        ///< first byte of the value
  std::uint32_t length = 0;    ///< kUndefinedLength: fragments or a sequence
};

/// The item of a sequence that an element lies in.
struct DicomStep {
  std::uint32_t sequence = 0;
  std::uint32_t item = 0;
};
using DicomPath = std::vector<DicomStep>;

enum class WalkEnd {
  pixels,   ///< at the pixel data
  end,      ///< of the data set, without pixel data
  cut,      ///< the file ends within an element
  damaged,  ///< no data set, or one of endless nesting
};

struct WalkResult {
  WalkEnd end = WalkEnd::end;
  DicomElement pixels{};  ///< (7FE0,0010), where it ends so
  std::uint64_t at = 0;   ///< where the walk ended
  DicomCoding coding{};   ///< that the data set really has
};

/// `visit` sees every element of the data set and of the sequences named in `entered`; other sequences are passed.
WalkResult walkDataSet(const DicomBytes& bytes, std::uint64_t from_byte, DicomCoding coding,
                       const std::vector<std::uint32_t>& entered,
                       const std::function<void(const DicomPath&, const DicomElement&)>& visit);

/// Of a frame in encapsulated pixel data.
struct DicomFragment {
  std::uint64_t at = 0;
  std::uint32_t length = 0;
};

struct DicomFragments {
  std::vector<DicomFragment> parts;  ///< the first is the table of offsets
  bool is_whole = false;             ///< up to the delimiter, or to the end of the file
  std::uint64_t missing_bytes = 0;   ///< of the last part
};
DicomFragments fragmentsAt(const DicomBytes& bytes, std::uint64_t from_byte, bool is_big_endian);

/// An integer of 2 or 4 bytes; 0 beyond the end.
std::uint32_t integerAt(const DicomBytes& bytes, std::uint64_t at, unsigned count, bool is_big_endian);

}  // namespace assets
