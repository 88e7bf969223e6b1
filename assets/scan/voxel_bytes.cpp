#include "assets/scan/voxel_bytes.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <memory>
#include <optional>
#include <vector>

#include "assets/load_error.h"
#include "assets/scan/header_text.h"

namespace assets {

namespace {

constexpr std::size_t kBlockBytes = 1 << 20;
constexpr double kDeflateAtBest = 1040.0;  // deflate packs 1032:1 at most (RFC 1951: 258 bytes in 2 bits)

[[noreturn]] void refuseShort(const std::string& path) {
  refuseScan(path,
             "it is truncated or damaged: it holds fewer voxels than its header promises; export the volume again");
}

/// Bytes one after the other, as the voxels need them.
class ByteSource {
 public:
  virtual ~ByteSource() = default;
  /// How many were there: fewer than asked for at the end only.
  virtual std::size_t fill(std::span<char> bytes) = 0;
};

class RawSource : public ByteSource {
 public:
  RawSource(const PlainFile& file, std::uint64_t from_byte) : file_(file), at_(from_byte) {}

  std::size_t fill(std::span<char> bytes) override {
    const std::size_t got = file_.readAt(at_, bytes);
    at_ += got;
    return got;
  }

 private:
  const PlainFile& file_;
  std::uint64_t at_;
};

/// A gzip stream, of several members too, or a bare zlib stream.
class UnpackedSource : public ByteSource {
 public:
  UnpackedSource(const PlainFile& file, std::uint64_t from_byte)
      : packed_(file, from_byte), path_(file.path()), block_(kBlockBytes / 4) {
    constexpr int kEitherKind = 15 + 32;  // zlib.h: the largest window, gzip or zlib by its first bytes
    if (inflateInit2(&stream_, kEitherKind) != Z_OK) throw std::bad_alloc();
  }
  ~UnpackedSource() override { inflateEnd(&stream_); }
  UnpackedSource(const UnpackedSource&) = delete;
  UnpackedSource& operator=(const UnpackedSource&) = delete;

  std::size_t fill(std::span<char> bytes) override {
    stream_.next_out = reinterpret_cast<Bytef*>(bytes.data());
    stream_.avail_out = static_cast<uInt>(bytes.size());
    while (stream_.avail_out > 0 && !has_ended_) {
      if (stream_.avail_in == 0 && !readMore()) refuseShort(path_);
      const int state = inflate(&stream_, Z_NO_FLUSH);
      if (state == Z_STREAM_END)
        beginNextMember();
      else if (state == Z_MEM_ERROR)
        throw std::bad_alloc();
      else if (state != Z_OK)
        refuseScan(path_, "its packed voxels are damaged (the checksum does not fit); export the volume again");
    }
    return bytes.size() - stream_.avail_out;
  }

 private:
  bool readMore() {
    stream_.next_in = reinterpret_cast<Bytef*>(block_.data());
    stream_.avail_in = static_cast<uInt>(packed_.fill(block_));
    return stream_.avail_in > 0;
  }

  /// Behind a member another one begins, or the file ends.
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
      refuseScan(path_, "more stands behind its packed voxels than belongs there; export the volume again");
  }

  RawSource packed_;
  std::string path_;
  std::vector<char> block_;
  z_stream stream_{};
  bool has_ended_ = false;
};

/// The characters of a file one by one.
class Characters {
 public:
  Characters(const PlainFile& file, std::uint64_t from_byte) : raw_(file, from_byte), block_(kBlockBytes / 4) {}

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

bool isBetweenNumbers(char c) { return c == ' ' || c == ',' || (c >= '\t' && c <= '\r'); }

/// Two hexadecimal digits a byte, white space anywhere.
class HexSource : public ByteSource {
 public:
  HexSource(const PlainFile& file, std::uint64_t from_byte) : characters_(file, from_byte), path_(file.path()) {}

  std::size_t fill(std::span<char> bytes) override {
    std::size_t done = 0;
    for (; done < bytes.size(); ++done) {
      const auto high = digit();
      if (!high) break;
      const auto low = digit();
      if (!low) refuseShort(path_);
      bytes[done] = static_cast<char>(*high << 4 | *low);
    }
    return done;
  }

 private:
  std::optional<int> digit() {
    while (const auto c = characters_.next()) {
      if (isBetweenNumbers(*c)) continue;
      if (*c >= '0' && *c <= '9') return *c - '0';
      if (*c >= 'a' && *c <= 'f') return *c - 'a' + 10;
      if (*c >= 'A' && *c <= 'F') return *c - 'A' + 10;
      refuseScan(path_, "its voxels are not hexadecimal digits as its header says; export the volume again");
    }
    return std::nullopt;
  }

  Characters characters_;
  std::string path_;
};

/// Numbers written out; each becomes the bytes of a `Stored`.
template <class Stored>
class TextSource : public ByteSource {
 public:
  TextSource(const PlainFile& file, std::uint64_t from_byte) : characters_(file, from_byte), path_(file.path()) {}

  std::size_t fill(std::span<char> bytes) override {
    std::size_t done = 0;
    for (; done + sizeof(Stored) <= bytes.size(); done += sizeof(Stored)) {
      const std::string word = nextWord();
      if (word.empty()) break;
      const auto stored = std::bit_cast<std::array<char, sizeof(Stored)>>(number(word));
      std::copy(stored.begin(), stored.end(), bytes.begin() + static_cast<std::ptrdiff_t>(done));
    }
    return done;
  }

 private:
  std::string nextWord() {
    constexpr std::size_t kLongest = 64;
    std::string word;
    while (const auto c = characters_.next()) {
      if (!isBetweenNumbers(*c))
        word += *c;
      else if (!word.empty())
        break;
      if (word.size() > kLongest) refuseWord(word);
    }
    return word;
  }

  Stored number(std::string_view word) const {
    Stored value{};
    const std::string_view digits = word.starts_with('+') ? word.substr(1) : word;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size()) refuseWord(word);
    return value;
  }

  [[noreturn]] void refuseWord(std::string_view word) const {
    refuseScan(path_, "its voxel " + asShown(word) + " is no number of the type it states; export the volume again");
  }

  Characters characters_;
  std::string path_;
};

std::unique_ptr<ByteSource> textSource(VoxelType type, const PlainFile& file, std::uint64_t from_byte) {
  switch (type) {
    case VoxelType::int8:
      return std::make_unique<TextSource<std::int8_t>>(file, from_byte);
    case VoxelType::uint8:
      return std::make_unique<TextSource<std::uint8_t>>(file, from_byte);
    case VoxelType::int16:
      return std::make_unique<TextSource<std::int16_t>>(file, from_byte);
    case VoxelType::uint16:
      return std::make_unique<TextSource<std::uint16_t>>(file, from_byte);
    case VoxelType::int32:
      return std::make_unique<TextSource<std::int32_t>>(file, from_byte);
    case VoxelType::uint32:
      return std::make_unique<TextSource<std::uint32_t>>(file, from_byte);
    case VoxelType::int64:
      return std::make_unique<TextSource<std::int64_t>>(file, from_byte);
    case VoxelType::uint64:
      return std::make_unique<TextSource<std::uint64_t>>(file, from_byte);
    case VoxelType::float32:
      return std::make_unique<TextSource<float>>(file, from_byte);
    case VoxelType::float64:
      break;
  }
  return std::make_unique<TextSource<double>>(file, from_byte);
}

/// Where the voxels of one data file begin, behind the lines to skip.
std::uint64_t firstByte(const ImageHeader& header, const PlainFile& file, std::uint64_t from_byte) {
  if (header.skipped_lines == 0) return from_byte;
  Characters characters(file, from_byte);
  std::uint64_t at = from_byte;
  for (std::int64_t lines = 0; lines < header.skipped_lines; ++at) {
    const auto c = characters.next();
    if (!c) refuseShort(file.path());
    lines += *c == '\n' ? 1 : 0;
  }
  return at;
}

std::uint64_t bytesInEachFile(const ImageHeader& header) {
  return header.voxelCount() / header.files.size() * bytesOf(header.type);
}

void skipBytes(ByteSource& source, std::int64_t count, const std::string& path) {
  std::vector<char> passed(static_cast<std::size_t>(std::min<std::int64_t>(count, kBlockBytes)));
  while (count > 0) {
    const auto step = static_cast<std::size_t>(std::min<std::int64_t>(count, kBlockBytes));
    if (source.fill(std::span(passed).first(step)) < step) refuseShort(path);
    count -= static_cast<std::int64_t>(step);
  }
}

/// The bytes of one data file, behind all that is skipped.
std::unique_ptr<ByteSource> sourceOf(const ImageHeader& header, const PlainFile& file, std::uint64_t from_byte) {
  const std::uint64_t first = firstByte(header, file, from_byte);
  const std::uint64_t bytes = bytesInEachFile(header);
  if (header.skipped_bytes == kVoxelsEndTheFile) {
    if (header.coding != VoxelCoding::raw)
      refuseScan(file.path(), "its packed voxels have no stated place (a skip of -1); export the volume again");
    if (file.size() < first + bytes) refuseShort(file.path());
    return std::make_unique<RawSource>(file, file.size() - bytes);
  }

  // A skip is of unpacked bytes where they are packed.
  const bool is_packed = header.coding == VoxelCoding::gzip;
  const auto skipped = static_cast<std::uint64_t>(header.skipped_bytes);
  if (!is_packed && skipped > file.size()) refuseShort(file.path());
  const std::uint64_t start = is_packed ? first : first + skipped;
  switch (header.coding) {
    case VoxelCoding::raw:
      return std::make_unique<RawSource>(file, start);
    case VoxelCoding::hex:
      return std::make_unique<HexSource>(file, start);
    case VoxelCoding::text:
      return textSource(header.type, file, start);
    case VoxelCoding::gzip:
      break;
  }
  auto unpacked = std::make_unique<UnpackedSource>(file, start);
  skipBytes(*unpacked, header.skipped_bytes, file.path());
  return unpacked;
}

/// Nothing may follow the voxels but a line's end in a file of raw ones; reading on also checks the checksum at a
/// packed stream's end.
void refuseMore(ByteSource& source, VoxelCoding coding, const std::string& path) {
  const std::size_t line_end = coding == VoxelCoding::raw ? 2 : 0;
  std::array<char, 8> more{};
  const std::size_t got = source.fill(more);
  const auto is_line_end = [](char c) { return c == '\n' || c == '\r'; };
  if (got > line_end || !std::all_of(more.begin(), more.begin() + static_cast<std::ptrdiff_t>(got), is_line_end))
    refuseScan(path, "it holds more voxels than its header promises; export the volume again");
}

}  // namespace

void refuseUnlessLongEnough(const ImageHeader& header) {
  const auto bytes = static_cast<double>(bytesInEachFile(header));
  for (const VoxelFile& each : header.files) {
    const PlainFile file(each.path);
    const auto held = static_cast<double>(file.size() - std::min(each.from_byte, file.size()));
    double needed = bytes;
    if (header.coding == VoxelCoding::gzip) needed = bytes / kDeflateAtBest;
    if (header.coding == VoxelCoding::hex) needed = 2.0 * bytes;
    if (header.coding == VoxelCoding::text) needed = 2.0 * bytes / static_cast<double>(bytesOf(header.type)) - 1.0;
    if (held < needed) refuseShort(each.path);
  }
}

void forVoxelBytes(const ImageHeader& header, const std::function<void(std::span<const char>)>& take) {
  std::vector<char> block(kBlockBytes);
  for (const VoxelFile& each : header.files) {
    const PlainFile file(each.path);
    const auto source = sourceOf(header, file, each.from_byte);
    for (std::uint64_t left = bytesInEachFile(header); left > 0;) {
      const std::span<char> next =
          std::span(block).first(static_cast<std::size_t>(std::min<std::uint64_t>(left, kBlockBytes)));
      if (source->fill(next) < next.size()) refuseShort(each.path);
      take(next);
      left -= next.size();
    }
    if (header.skipped_bytes != kVoxelsEndTheFile) refuseMore(*source, header.coding, each.path);
  }
}

bool isGzip(const PlainFile& file) {
  std::array<char, 2> magic{};
  return file.readAt(0, magic) == 2 && magic[0] == '\x1f' && magic[1] == '\x8b';
}

std::string firstUnpackedBytes(const PlainFile& file, std::size_t count) {
  std::string bytes(count, '\0');
  try {
    UnpackedSource source(file, 0);
    bytes.resize(source.fill(bytes));
  } catch (const LoadError&) {
    bytes.clear();
  }
  return bytes;
}

}  // namespace assets
