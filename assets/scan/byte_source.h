// A stream of voxel bytes, and the source that passes a file's bytes on unchanged. Throws LoadError of one line where
// the file ends too soon. One thread each; the file must outlive it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "assets/scan/header_text.h"
#include "assets/scan/regular_file.h"

namespace assets {

inline constexpr std::size_t kBlockBytes = 1 << 20;

[[noreturn]] inline void refuseTruncated(const std::string& path) {
  refuseScan(path, "it is truncated or damaged: it holds fewer voxels than its header states; export the volume again");
}

class ByteSource {
 public:
  virtual ~ByteSource() = default;
  /// Number of bytes read; fewer than requested only at the end.
  virtual std::size_t fill(std::span<char> bytes) = 0;
};

class RawSource : public ByteSource {
 public:
  RawSource(const RegularFile& file, std::uint64_t from_byte) : file_(file), at_(from_byte) {}

  std::size_t fill(std::span<char> bytes) override {
    const std::size_t got = file_.readAt(at_, bytes);
    at_ += got;
    return got;
  }

 private:
  const RegularFile& file_;
  std::uint64_t at_;
};

}  // namespace assets
