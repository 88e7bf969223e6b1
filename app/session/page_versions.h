// Versions of a long array of bytes of which few pages change from one version to the next: only pages that were given
// are stored. Any one thread; put() and at() about 0.1 us. Memory: the pages given, 24 bytes a page of the array, 8 a
// page given.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace app {

class PageVersions {
 public:
  PageVersions(std::size_t page_bytes, std::size_t pages) : page_bytes_(page_bytes), pages_(pages) {}

  /// The content of a page from a version on; versions do not fall from call to call.
  void put(std::size_t page, std::uint32_t version, std::span<const std::byte> content);
  /// As it was at a version; empty: as before all of them.
  std::span<const std::byte> at(std::size_t page, std::uint32_t version) const;

  /// Drops the odd versions: from now on version 2 n has the number n. The newest must be even.
  void halve();

  std::size_t pages() const { return pages_.size(); }
  std::size_t bytes() const;

 private:
  struct Entry {
    std::uint32_t version = 0, slot = 0;
  };
  static constexpr std::size_t kSlotsInChunk = 1024;
  std::byte* slot(std::uint32_t number) const {
    return chunks_[number / kSlotsInChunk].get() + number % kSlotsInChunk * page_bytes_;
  }

  std::size_t page_bytes_;
  std::vector<std::vector<Entry>> pages_;
  std::vector<std::unique_ptr<std::byte[]>> chunks_;
  std::vector<std::uint32_t> free_;
  std::uint32_t used_ = 0;
};

/// Versions of arrays that change in place, found by comparison with a copy of them, from a version of zeros on.
class ArrayVersions {
 public:
  using Arrays = std::span<const std::span<std::byte>>;

  explicit ArrayVersions(std::size_t page_bytes) : page_bytes_(page_bytes) {}
  /// The arrays have the same sizes in every call.
  void keep(Arrays arrays, std::uint32_t version);
  void restore(Arrays arrays, std::uint32_t version) const;
  void halve();
  std::size_t bytes() const;

 private:
  std::size_t page_bytes_;
  std::vector<PageVersions> versions_;          ///< by array
  std::vector<std::vector<std::byte>> newest_;  ///< alike
};

}  // namespace app
