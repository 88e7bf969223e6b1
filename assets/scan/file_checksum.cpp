#include "assets/scan/file_checksum.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <vector>

#include "assets/load_error.h"

namespace assets {

namespace {

constexpr std::array<char, 8> kMark = {'M', 'O', 'L', 'A', 'R', 'S', 'E', 'A'};
constexpr std::size_t kTrailerBytes = 24;
using Trailer = std::array<char, kTrailerBytes>;

void putLittle(char* at, std::uint64_t value, int bytes) {
  for (int b = 0; b < bytes; ++b) at[b] = static_cast<char>(value >> (8 * b) & 0xff);
}

/// For the first `length` bytes of the file.
Trailer trailerOf(std::istream& file, std::uint64_t length) {
  uLong crc = ::crc32(0, nullptr, 0);
  uLong adler = ::adler32(0, nullptr, 0);
  constexpr std::uint64_t kMegabyte = 1 << 20;
  std::vector<char> block(std::min(length, kMegabyte));
  for (std::uint64_t left = length; left > 0 && file;) {
    file.read(block.data(), static_cast<std::streamsize>(std::min<std::uint64_t>(left, block.size())));
    const auto got = static_cast<uInt>(file.gcount());
    crc = ::crc32(crc, reinterpret_cast<const Bytef*>(block.data()), got);
    adler = ::adler32(adler, reinterpret_cast<const Bytef*>(block.data()), got);
    left -= got;
  }
  Trailer result{};
  putLittle(result.data(), length, 8);
  putLittle(result.data() + 8, crc, 4);
  putLittle(result.data() + 12, adler, 4);
  std::copy(kMark.begin(), kMark.end(), result.begin() + 16);
  return result;
}

}  // namespace

void appendChecksum(const std::string& path) {
  std::error_code error;
  const std::uint64_t length = std::filesystem::file_size(path, error);
  std::ifstream input(path, std::ios::binary);
  if (error || !input) throw LoadError(path + ": it cannot be read back; check the disk");
  const Trailer end = trailerOf(input, length);
  std::ofstream output(path, std::ios::binary | std::ios::app);
  output.write(end.data(), kTrailerBytes);
  if (!output.flush()) throw LoadError(path + ": writing failed; make room on the disk");
}

void requireChecksum(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw LoadError(path + ": there is no such file; import the scan again");
  const std::uint64_t bytes = std::filesystem::file_size(path, error);
  std::ifstream file(path, std::ios::binary);
  if (error || !file) throw LoadError(path + ": it may not be read; check its permissions");

  Trailer found{};
  if (bytes > kTrailerBytes) {
    file.seekg(static_cast<std::streamoff>(bytes - kTrailerBytes));
    file.read(found.data(), kTrailerBytes);
    file.seekg(0);
  }
  if (!std::equal(kMark.begin(), kMark.end(), found.begin() + 16))
    throw LoadError(path + ": it is cut short, or was not written by this program; import the scan again");
  if (trailerOf(file, bytes - kTrailerBytes) != found)
    throw LoadError(path + ": it is damaged (its checksum does not fit); import the scan again");
}

}  // namespace assets
