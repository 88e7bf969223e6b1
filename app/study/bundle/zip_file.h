// ZIP files by libzip, the same bytes of the same contents on every machine: names in order, one time for all (1980),
// no locale, no user. A seal over every byte of the file stands in its comment: a change between the files is found
// too. Main thread; as fast as the disk.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace app {

/// Of bytes, which are compressed, or of a file, which is stored as it is.
struct ZipEntry {
  std::string name, bytes;
  std::string path;  ///< empty: `bytes`
};

/// Over the file of this name, whole or with an exception: LoadError where an entry's file cannot be read, UsageError
/// where the disk refuses.
void writeZip(const std::string& path, std::vector<ZipEntry> entries);

/// none: no file of writeZip, or its end is cut off.
enum class ZipSeal : std::uint8_t { none, intact, broken };
ZipSeal zipSeal(const std::string& path);

/// A file that may be a stranger's.
class ZipReader {
 public:
  static constexpr std::size_t kMostEntries = 100'000;

  /// Throws LoadError: no such file, or its directory cannot be read.
  explicit ZipReader(const std::string& path);
  ~ZipReader();
  ZipReader(const ZipReader&) = delete;
  ZipReader& operator=(const ZipReader&) = delete;

  /// In the order of the file.
  std::vector<std::string> names() const;
  /// Hands over the content in pieces. False: there is no such entry, it does not unpack, or is longer than `most`.
  bool read(const std::string& name, std::uint64_t most, const std::function<void(std::string_view)>& take) const;
  /// Of a small entry; none as above.
  std::optional<std::string> text(const std::string& name, std::uint64_t most) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace app
