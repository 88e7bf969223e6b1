#include "app/session/file_seal.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <tuple>

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

// Offsets in the header of a database, https://www.sqlite.org/fileformat.html
constexpr std::uint64_t kPageSizeOffset = 16, kReadVersionOffset = 19, kPageCountOffset = 28, kApplicationIdOffset = 68;
constexpr std::string_view kDatabaseMark = "SQLite format 3";

/// An open file; empty if it cannot be opened.
class OpenFile {
 public:
  explicit OpenFile(const std::string& path) : file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
  ~OpenFile() {
    if (file_ >= 0) ::close(file_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  operator int() const { return file_; }

 private:
  int file_;
};

std::uint64_t bytesIn(int file) {
  struct stat status {};
  return ::fstat(file, &status) == 0 ? static_cast<std::uint64_t>(status.st_size) : 0;
}

std::string textAt(int file, std::uint64_t offset, std::size_t bytes) {
  std::string text(bytes, '\0');
  const ssize_t read = ::pread(file, text.data(), bytes, static_cast<off_t>(offset));
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(0, read)));
  return text;
}

std::uint64_t bigEndianAt(int file, std::uint64_t offset, std::size_t bytes) {
  std::uint64_t value = 0;
  for (const char c : textAt(file, offset, bytes)) value = value << 8 | static_cast<unsigned char>(c);
  return value;
}

/// The size in its header.
std::uint64_t databaseBytes(int file) {
  const std::uint64_t page = bigEndianAt(file, kPageSizeOffset, 2);
  return (page == 1 ? 65'536 : page) * bigEndianAt(file, kPageCountOffset, 4);
}

Digest digestOfFirst(int file, std::uint64_t bytes, const std::string& path) {
  constexpr std::uint64_t kChunkBytes = 1 << 20;
  Sha256 hash;
  for (std::uint64_t done = 0; done < bytes;) {
    const std::string chunk = textAt(file, done, std::min(bytes - done, kChunkBytes));
    if (chunk.empty())
      throw SessionError(path + ": cannot be read to its end: check the disk", SessionErrorKind::failed);
    hash.add({reinterpret_cast<const std::uint8_t*>(chunk.data()), chunk.size()});
    done += chunk.size();
  }
  return hash.finish();
}

std::string trailer(const Digest& digest) {
  return std::string(kTrailerMark) + std::string(reinterpret_cast<const char*>(digest.data()), digest.size());
}

/// The beginning of the expected trailer, then nothing or zeros that were never overwritten.
bool isCutShort(const std::string& found, const std::string& expected) {
  const auto written = std::ranges::mismatch(found, expected).in1;
  const bool only_zeros = std::all_of(written, found.end(), [](char c) { return c == '\0'; });
  constexpr std::ptrdiff_t kFewestZeros = 4;  // fewer may be a changed byte
  return only_zeros && (found.size() < expected.size() || found.end() - written >= kFewestZeros);
}

}  // namespace

void sealFile(int file, const std::string& path) {
  const std::uint64_t size = bytesIn(file);
  const std::string bytes = trailer(digestOfFirst(file, size, path));
  const ssize_t written = ::pwrite(file, bytes.data(), bytes.size(), static_cast<off_t>(size));
  if (written == static_cast<ssize_t>(bytes.size()) && ::fsync(file) == 0) return;
  std::ignore = ::ftruncate(file, static_cast<off_t>(size));
  throw SessionError(path + ": its seal cannot be written: check the free space on the disk", SessionErrorKind::failed);
}

FileSeal fileSeal(const std::string& path) {
  const OpenFile file(path);
  const std::uint64_t size = bytesIn(file), database = databaseBytes(file);
  if (size == database) return FileSeal::none;
  if (size < database || size > database + kTrailerBytes) return FileSeal::broken;
  const std::string expected = trailer(digestOfFirst(file, database, path));
  const std::string found = textAt(file, database, static_cast<std::size_t>(size - database));
  if (found == expected) return FileSeal::intact;
  return isCutShort(found, expected) ? FileSeal::incomplete : FileSeal::broken;
}

bool isDatabase(const std::string& path) { return textAt(OpenFile(path), 0, kDatabaseMark.size()) == kDatabaseMark; }

bool hasSessionMark(const std::string& path) {
  std::error_code failed;
  if (!std::filesystem::is_regular_file(path, failed)) return false;
  const OpenFile file(path);
  const std::uint64_t size = bytesIn(file);
  return textAt(file, kApplicationIdOffset, kApplicationMark.size()) == kApplicationMark ||
         (size > kTrailerBytes && textAt(file, size - kTrailerBytes, kTrailerMark.size()) == kTrailerMark);
}

bool needsLog(const std::string& path) {
  return isDatabase(path) && bigEndianAt(OpenFile(path), kReadVersionOffset, 1) == 2;
}

}  // namespace app
