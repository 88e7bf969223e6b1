// How a DICOM data set and its pictures are packed (PS3.5 annex A): the table of those that are read, and the names of
// some that are not. Plain data; any thread.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace assets {

enum class PixelPacking { plain, run_length, jpeg, jpeg_ls, jpeg_2000 };

struct TransferSyntax {
  std::string_view uid;
  std::string_view name;  ///< for people
  PixelPacking packing = PixelPacking::plain;
  bool is_implicit = false;    ///< elements without their type
  bool is_big_endian = false;  ///< of data set and pixels
  bool is_deflated = false;    ///< the whole data set
  bool is_lossy = false;       ///< grey values differ from those that were scanned
};

inline constexpr std::array<TransferSyntax, 15> kTransferSyntaxes = {{
    {"1.2.840.10008.1.2", "implicit little endian", PixelPacking::plain, true},
    {"1.2.840.10008.1.2.1", "uncompressed", PixelPacking::plain},
    {"1.2.840.10008.1.2.2", "big endian", PixelPacking::plain, false, true},
    {"1.2.840.10008.1.2.1.99", "deflated", PixelPacking::plain, false, false, true},
    {"1.2.840.10008.1.2.5", "RLE", PixelPacking::run_length},
    {"1.2.840.10008.1.2.4.50", "JPEG, 8 bit, lossy", PixelPacking::jpeg, false, false, false, true},
    {"1.2.840.10008.1.2.4.51", "JPEG, 12 bit, lossy", PixelPacking::jpeg, false, false, false, true},
    {"1.2.840.10008.1.2.4.53", "JPEG, spectral, lossy", PixelPacking::jpeg, false, false, false, true},
    {"1.2.840.10008.1.2.4.55", "JPEG, progressive, lossy", PixelPacking::jpeg, false, false, false, true},
    {"1.2.840.10008.1.2.4.57", "JPEG lossless", PixelPacking::jpeg},
    {"1.2.840.10008.1.2.4.70", "JPEG lossless", PixelPacking::jpeg},
    {"1.2.840.10008.1.2.4.80", "JPEG-LS lossless", PixelPacking::jpeg_ls},
    {"1.2.840.10008.1.2.4.81", "JPEG-LS, lossy", PixelPacking::jpeg_ls, false, false, false, true},
    {"1.2.840.10008.1.2.4.90", "JPEG 2000 lossless", PixelPacking::jpeg_2000},
    {"1.2.840.10008.1.2.4.91", "JPEG 2000, lossy", PixelPacking::jpeg_2000, false, false, false, true},
}};

/// None: not read here.
constexpr const TransferSyntax* transferSyntax(std::string_view uid) {
  for (const TransferSyntax& syntax : kTransferSyntaxes)
    if (syntax.uid == uid) return &syntax;
  return nullptr;
}

/// Of those that are not read: the standard's name, or a general word. Never text of the file.
std::string unreadSyntaxName(std::string_view uid);

}  // namespace assets
