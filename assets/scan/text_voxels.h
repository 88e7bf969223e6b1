// Voxels written as hexadecimal digits, or as numbers separated by white space and commas. Throws LoadError of one line
// for anything else. One thread a source; 256 KB of memory; about 40 MB/s.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "assets/scan/byte_source.h"
#include "assets/scan/regular_file.h"
#include "assets/scan/voxel_type.h"

namespace assets {

/// The characters of a file one by one.
class CharacterReader {
 public:
  CharacterReader(const RegularFile& file, std::uint64_t from_byte)
      : raw_(file, from_byte),
        block_(static_cast<std::size_t>(std::clamp<std::uint64_t>(file.size(), 1, kBlockBytes / 4))) {}

  std::optional<char> next() {
    if (at_ == end_) {
      at_ = 0;
      end_ = raw_.fill(block_);
      if (end_ == 0) return std::nullopt;
    }
    return block_[at_++];
  }

 private:
  RawSource raw_;
  std::vector<char> block_;
  std::size_t at_ = 0;
  std::size_t end_ = 0;
};

/// Two hexadecimal digits a byte, white space anywhere.
std::unique_ptr<ByteSource> hexSource(const RegularFile& file, std::uint64_t from_byte);

/// Each number becomes the bytes of a voxel of that type, in native byte order.
std::unique_ptr<ByteSource> textSource(VoxelType type, const RegularFile& file, std::uint64_t from_byte);

}  // namespace assets
