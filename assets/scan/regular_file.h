// A regular file open for reading, never a folder, device or pipe, which could block. Throws LoadError of one line. Any
// thread may read; one system call a read.
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

  /// Number of bytes read; fewer than requested only at the end of the file.
  std::size_t readAt(std::uint64_t from_byte, std::span<char> bytes) const;

 private:
  std::string path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace assets
