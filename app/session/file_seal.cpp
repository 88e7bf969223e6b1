#include "app/session/file_seal.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <vector>

#include "app/session/session_error.h"
#include "app/session/session_format.h"
#include "calibration/record/sha256.h"

namespace app {
namespace {

using calibration::Digest;
using calibration::Sha256;

using session_format::kApplicationMark;
using session_format::kTrailerBytes;
using session_format::kTrailerMark;

constexpr std::uint64_t kSmallestPage = 512;  // every SQLite page size is a multiple of it

std::uint64_t bytesIn(std::ifstream& in) {
  in.seekg(0, std::ios::end);
  const auto end = in.tellg();
  in.seekg(0);
  return in && end > 0 ? static_cast<std::uint64_t>(end) : 0;
}

Digest digestOfFirst(std::ifstream& in, std::uint64_t bytes, const std::string& path) {
  Sha256 hash;
  std::vector<char> chunk(1 << 20);
  for (std::uint64_t left = bytes; left > 0;) {
    const auto want = static_cast<std::streamsize>(std::min<std::uint64_t>(left, chunk.size()));
    if (!in.read(chunk.data(), want)) throw SessionError(path + ": can not be read to its end: check the disk");
    hash.add({reinterpret_cast<const std::uint8_t*>(chunk.data()), static_cast<std::size_t>(want)});
    left -= static_cast<std::uint64_t>(want);
  }
  return hash.finish();
}

std::string trailer(const Digest& digest) {
  return std::string(kTrailerMark) + std::string(reinterpret_cast<const char*>(digest.data()), digest.size());
}

}  // namespace

void sealFile(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  const std::uint64_t size = bytesIn(in);
  const std::string seal = trailer(digestOfFirst(in, size, path));
  std::ofstream out(path, std::ios::binary | std::ios::app);
  out.write(seal.data(), static_cast<std::streamsize>(seal.size()));
  out.close();
  if (out) return;
  std::error_code failed;
  std::filesystem::resize_file(path, size, failed);
  throw SessionError(path + ": its closing seal can not be written: check the free space on the disk");
}

FileSeal fileSeal(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  const std::uint64_t size = bytesIn(in);
  // A database alone is whole pages; anything else must be whole pages and an intact trailer.
  if (size % kSmallestPage == 0) return FileSeal::none;
  if (size % kSmallestPage != kTrailerBytes % kSmallestPage) return FileSeal::broken;
  const std::string expected = trailer(digestOfFirst(in, size - kTrailerBytes, path));
  std::string found(kTrailerBytes, '\0');
  in.read(found.data(), static_cast<std::streamsize>(found.size()));
  return in && found == expected ? FileSeal::intact : FileSeal::broken;
}

bool bearsSessionMark(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  const std::uint64_t size = bytesIn(in);
  const auto text_at = [&](std::uint64_t place, std::size_t bytes) {
    std::string text(bytes, '\0');
    in.clear();
    in.seekg(static_cast<std::streamoff>(place));
    in.read(text.data(), static_cast<std::streamsize>(bytes));
    return text;
  };
  constexpr std::uint64_t kApplicationIdPlace = 68;  // https://www.sqlite.org/fileformat.html
  return text_at(kApplicationIdPlace, kApplicationMark.size()) == kApplicationMark ||
         (size > kTrailerBytes && text_at(size - kTrailerBytes, kTrailerMark.size()) == kTrailerMark);
}

}  // namespace app
