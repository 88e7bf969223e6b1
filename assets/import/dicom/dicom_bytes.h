// Bytes of one DICOM file, whatever stores them: the file itself through a window of 64 KB, or the inflated data set of
// a deflated file in memory. Reading beyond the end or from a broken disk is an answer, not an exception. One thread
// each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace assets {

class RegularFile;

class DicomBytes {
 public:
  /// Throws LoadError where the file cannot be opened; its text holds the path and is for nobody.
  explicit DicomBytes(const std::string& path);
  ~DicomBytes();
  DicomBytes(DicomBytes&&) noexcept;

  /// Of memory.
  static DicomBytes ofMemory(std::string bytes);
  /// Of memory that outlives it.
  static DicomBytes ofView(std::span<const char> bytes);

  std::uint64_t size() const { return size_; }
  /// False, with nothing promised of `out`, unless all of it lies in the file and can be read.
  bool read(std::uint64_t from_byte, std::span<char> out) const;

  /// From `from_byte` on, everything is the raw deflate stream of what takes its place; the bytes before stay. False:
  /// damaged, or longer than 2 GB.
  bool inflateFrom(std::uint64_t from_byte);

 private:
  DicomBytes();

  std::unique_ptr<RegularFile> file_;
  std::string memory_;            ///< instead of the file
  std::span<const char> view_{};  ///< instead of both
  std::uint64_t size_ = 0;
  mutable std::uint64_t window_begin_ = 0;
  mutable std::vector<char> window_;
};

}  // namespace assets
