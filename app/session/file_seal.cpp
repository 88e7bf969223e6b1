#include "app/session/file_seal.h"

#include <fcntl.h>
#include <unistd.h>

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

// Places in the header of a database, https://www.sqlite.org/fileformat.html
constexpr std::uint64_t kPageSizePlace = 16, kReadVersionPlace = 19, kPageCountPlace = 28, kApplicationIdPlace = 68;

std::uint64_t bytesIn(std::ifstream& in) {
  in.seekg(0, std::ios::end);
  const auto end = in.tellg();
  in.seekg(0);
  return in && end > 0 ? static_cast<std::uint64_t>(end) : 0;
}

std::string textAt(std::ifstream& in, std::uint64_t place, std::size_t bytes) {
  std::string text(bytes, '\0');
  in.clear();
  in.seekg(static_cast<std::streamoff>(place));
  in.read(text.data(), static_cast<std::streamsize>(bytes));
  text.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, in.gcount())));
  return text;
}

std::uint64_t bigEndianAt(std::ifstream& in, std::uint64_t place, std::size_t bytes) {
  std::uint64_t value = 0;
  for (const char c : textAt(in, place, bytes)) value = value << 8 | static_cast<unsigned char>(c);
  return value;
}

/// As its header has it.
std::uint64_t databaseBytes(std::ifstream& in) {
  const std::uint64_t page = bigEndianAt(in, kPageSizePlace, 2);
  return (page == 1 ? 65'536 : page) * bigEndianAt(in, kPageCountPlace, 4);
}

Digest digestOfFirst(std::ifstream& in, std::uint64_t bytes, const std::string& path) {
  Sha256 hash;
  std::vector<char> chunk(1 << 20);
  in.clear();
  in.seekg(0);
  for (std::uint64_t left = bytes; left > 0;) {
    const auto want = static_cast<std::streamsize>(std::min<std::uint64_t>(left, chunk.size()));
    if (!in.read(chunk.data(), want))
      throw SessionError(path + ": can not be read to its end: check the disk", SessionTrouble::failed);
    hash.add({reinterpret_cast<const std::uint8_t*>(chunk.data()), static_cast<std::size_t>(want)});
    left -= static_cast<std::uint64_t>(want);
  }
  return hash.finish();
}

std::string trailer(const Digest& digest) {
  return std::string(kTrailerMark) + std::string(reinterpret_cast<const char*>(digest.data()), digest.size());
}

/// The beginning of what it should be, and nothing behind it or zeros that were never written over.
bool isCutShort(const std::string& found, const std::string& expected) {
  const auto written = std::ranges::mismatch(found, expected).in1;
  const bool only_zeros = std::all_of(written, found.end(), [](char c) { return c == '\0'; });
  constexpr std::ptrdiff_t kFewestZeros = 4;  // fewer may be a changed byte
  return only_zeros && (found.size() < expected.size() || found.end() - written >= kFewestZeros);
}

bool writeSynced(const std::string& path, const std::string& bytes) {
  const int file = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (file < 0) return false;
  bool written = ::write(file, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size());
  written = ::fsync(file) == 0 && written;
  return ::close(file) == 0 && written;
}

}  // namespace

void waitUntilOnDisk(const std::string& path) {
  const int file = ::open(path.empty() ? "." : path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return;
  ::fsync(file);
  ::close(file);
}

void sealFile(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  const std::uint64_t size = bytesIn(in);
  if (writeSynced(path, trailer(digestOfFirst(in, size, path)))) return;
  std::error_code failed;
  std::filesystem::resize_file(path, size, failed);
  throw SessionError(path + ": its closing seal can not be written: check the free space on the disk",
                     SessionTrouble::failed);
}

FileSeal fileSeal(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  const std::uint64_t size = bytesIn(in), database = databaseBytes(in);
  if (size == database) return FileSeal::none;
  if (size < database || size > database + kTrailerBytes) return FileSeal::broken;
  const std::string expected = trailer(digestOfFirst(in, database, path));
  const std::string found = textAt(in, database, static_cast<std::size_t>(size - database));
  if (found == expected) return FileSeal::intact;
  return isCutShort(found, expected) ? FileSeal::incomplete : FileSeal::broken;
}

bool bearsSessionMark(const std::string& path) {
  std::error_code failed;
  if (!std::filesystem::is_regular_file(path, failed)) return false;
  std::ifstream in(path, std::ios::binary);
  const std::uint64_t size = bytesIn(in);
  return textAt(in, kApplicationIdPlace, kApplicationMark.size()) == kApplicationMark ||
         (size > kTrailerBytes && textAt(in, size - kTrailerBytes, kTrailerMark.size()) == kTrailerMark);
}

bool awaitsLog(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return textAt(in, 0, 15) == "SQLite format 3" && bigEndianAt(in, kReadVersionPlace, 1) == 2;
}

}  // namespace app
