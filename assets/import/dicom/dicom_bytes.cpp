#include "assets/import/dicom/dicom_bytes.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "assets/load_error.h"
#include "assets/scan/regular_file.h"

namespace assets {
namespace {

constexpr std::size_t kWindow_bytes = 1 << 16;
constexpr std::size_t kMaxInflated_bytes = std::size_t{2} << 30;

struct InflateStream {
  z_stream stream{};
  bool is_ready = false;
  InflateStream() { is_ready = inflateInit2(&stream, -15) == Z_OK; }  // raw deflate (PS3.5 A.5)
  ~InflateStream() { inflateEnd(&stream); }
  InflateStream(const InflateStream&) = delete;
  InflateStream& operator=(const InflateStream&) = delete;
};

}  // namespace

DicomBytes::DicomBytes() = default;
DicomBytes::DicomBytes(const std::string& path) : file_(std::make_unique<RegularFile>(path)), size_(file_->size()) {}
DicomBytes::~DicomBytes() = default;
DicomBytes::DicomBytes(DicomBytes&&) noexcept = default;

DicomBytes DicomBytes::ofMemory(std::string bytes) {
  DicomBytes made;
  made.size_ = bytes.size();
  made.memory_ = std::move(bytes);
  return made;
}

DicomBytes DicomBytes::ofView(std::span<const char> bytes) {
  DicomBytes made;
  made.size_ = bytes.size();
  made.view_ = bytes;
  return made;
}

bool DicomBytes::read(std::uint64_t from_byte, std::span<char> out) const {
  if (from_byte > size_ || out.size() > size_ - from_byte) return false;
  if (out.empty()) return true;
  if (!file_) {
    std::memcpy(out.data(), (view_.empty() ? memory_.data() : view_.data()) + from_byte, out.size());
    return true;
  }
  try {
    if (out.size() > kWindow_bytes / 2) return file_->readAt(from_byte, out) == out.size();
    const bool is_inside = from_byte >= window_begin_ && from_byte - window_begin_ + out.size() <= window_.size();
    if (!is_inside) {
      window_.resize(kWindow_bytes);
      window_begin_ = from_byte;
      window_.resize(file_->readAt(from_byte, window_));
      if (window_.size() < out.size()) return false;  // cut while it was read
    }
    std::memcpy(out.data(), window_.data() + (from_byte - window_begin_), out.size());
    return true;
  } catch (const LoadError&) {
    window_.clear();
    return false;
  }
}

bool DicomBytes::inflateFrom(std::uint64_t from_byte) {
  std::string whole(static_cast<std::size_t>(std::min(from_byte, size_)), '\0');
  if (!read(0, whole)) return false;
  InflateStream inflating;
  if (!inflating.is_ready) return false;
  z_stream& stream = inflating.stream;
  std::array<char, kWindow_bytes> packed;
  std::vector<char> plain(4 * kWindow_bytes);
  std::uint64_t at = from_byte;
  int state = Z_OK;
  while (state != Z_STREAM_END) {
    if (stream.avail_in == 0) {
      const std::size_t count = static_cast<std::size_t>(std::min<std::uint64_t>(packed.size(), size_ - at));
      if (count == 0 || !read(at, std::span(packed).first(count))) break;  // cut: what is there is judged by its length
      at += count;
      stream.next_in = reinterpret_cast<Bytef*>(packed.data());
      stream.avail_in = static_cast<uInt>(count);
    }
    stream.next_out = reinterpret_cast<Bytef*>(plain.data());
    stream.avail_out = static_cast<uInt>(plain.size());
    state = inflate(&stream, Z_NO_FLUSH);
    if (state != Z_OK && state != Z_STREAM_END && state != Z_BUF_ERROR) return false;
    whole.append(plain.data(), plain.size() - stream.avail_out);
    if (whole.size() > kMaxInflated_bytes) return false;
  }
  file_.reset();
  view_ = {};
  memory_ = std::move(whole);
  size_ = memory_.size();
  return true;
}

}  // namespace assets
