// A plain file, open for reading: never a folder, a device or a pipe, on which a reader could wait for ever. Throws
// LoadError of one line. Any thread may read; a system call a read.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace assets {

class RegularFile {
 public:
  explicit RegularFile(const std::string& path);
  ~RegularFile();
  RegularFile(const RegularFile&) = delete;
  RegularFile& operator=(const RegularFile&) = delete;

  const std::string& path() const { return path_; }
  std::uint64_t size() const { return size_; }

  /// How many bytes were there: fewer than asked for at the end of the file only.
  std::size_t readAt(std::uint64_t from_byte, std::span<char> bytes) const;

 private:
  std::string path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace assets
