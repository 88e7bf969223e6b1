#include "assets/scan/compressed_bytes.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <new>
#include <span>
#include <vector>

#include "assets/load_error.h"
#include "assets/scan/header_text.h"

namespace assets {

namespace {

/// At least a byte.
std::size_t sizeFor(const RegularFile& file) {
  return static_cast<std::size_t>(std::clamp<std::uint64_t>(file.size(), 1, kBlockBytes / 4));
}

class DecompressedSource : public ByteSource {
 public:
  DecompressedSource(const RegularFile& file, std::uint64_t from_byte)
      : file_bytes_(file, from_byte), path_(file.path()), block_(sizeFor(file)) {
    constexpr int kGzipOrZlib = 15 + 32;  // zlib.h: largest window, format by the first bytes
    if (inflateInit2(&stream_, kGzipOrZlib) != Z_OK) throw std::bad_alloc();
  }
  ~DecompressedSource() override { inflateEnd(&stream_); }
  DecompressedSource(const DecompressedSource&) = delete;
  DecompressedSource& operator=(const DecompressedSource&) = delete;

  std::size_t fill(std::span<char> bytes) override {
    stream_.next_out = reinterpret_cast<Bytef*>(bytes.data());
    stream_.avail_out = static_cast<uInt>(bytes.size());
    while (stream_.avail_out > 0 && !has_ended_) {
      if (stream_.avail_in == 0 && !readMore()) refuseTruncated(path_);
      const int state = inflate(&stream_, Z_NO_FLUSH);
      if (state == Z_STREAM_END)
        beginNextMember();
      else if (state == Z_MEM_ERROR)
        throw std::bad_alloc();
      else if (state != Z_OK)
        refuseScan(path_, "its compressed voxels are damaged (wrong checksum); export the volume again");
    }
    return bytes.size() - stream_.avail_out;
  }

 private:
  bool readMore() {
    stream_.next_in = reinterpret_cast<Bytef*>(block_.data());
    stream_.avail_in = static_cast<uInt>(file_bytes_.fill(block_));
    return stream_.avail_in > 0;
  }

  /// After a member another one begins, or the file ends.
  void beginNextMember() {
    if (stream_.avail_in == 0 && !readMore()) {
      has_ended_ = true;
      return;
    }
    constexpr Bytef kGzip = 0x1f;
    if (*stream_.next_in == kGzip) {
      inflateReset(&stream_);
      return;
    }
    has_ended_ = true;
    constexpr uInt kLineEnd = 2;
    if (stream_.avail_in > kLineEnd)
      refuseScan(path_, "it has extra bytes after its compressed voxels; export the volume again");
  }

  RawSource file_bytes_;
  std::string path_;
  std::vector<char> block_;
  z_stream stream_{};
  bool has_ended_ = false;
};

}  // namespace

std::unique_ptr<ByteSource> decompressedSource(const RegularFile& file, std::uint64_t from_byte) {
  return std::make_unique<DecompressedSource>(file, from_byte);
}

bool isGzip(const RegularFile& file) {
  std::array<char, 2> magic{};
  return file.readAt(0, magic) == 2 && magic[0] == '\x1f' && magic[1] == '\x8b';
}

std::string firstDecompressedBytes(const RegularFile& file, std::size_t count) {
  std::string bytes(count, '\0');
  try {
    DecompressedSource source(file, 0);
    bytes.resize(source.fill(bytes));
  } catch (const LoadError&) {
    bytes.clear();
  }
  return bytes;
}

}  // namespace assets
