#include "app/session/page_versions.h"

#include <algorithm>
#include <cassert>
#include <cstring>

namespace app {

void PageVersions::put(std::size_t page, std::uint32_t version, std::span<const std::byte> content) {
  assert(content.size() <= page_bytes_);
  std::vector<Entry>& entries = pages_[page];
  assert(entries.empty() || entries.back().version <= version);
  if (entries.empty() || entries.back().version != version) {
    if (free_.empty()) {
      if (used_ % kSlotsInChunk == 0)
        chunks_.push_back(std::make_unique_for_overwrite<std::byte[]>(kSlotsInChunk * page_bytes_));
      free_.push_back(used_++);
    }
    entries.push_back({version, free_.back()});
    free_.pop_back();
  }
  std::ranges::copy(content, slot(entries.back().slot));
}

std::span<const std::byte> PageVersions::at(std::size_t page, std::uint32_t version) const {
  const std::vector<Entry>& entries = pages_[page];
  const auto after = std::ranges::upper_bound(entries, version, {}, &Entry::version);
  if (after == entries.begin()) return {};
  return {slot(std::prev(after)->slot), page_bytes_};
}

void PageVersions::halve() {
  for (std::vector<Entry>& entries : pages_) {
    std::vector<Entry> left;
    for (const Entry& entry : entries) {
      const std::uint32_t version = (entry.version + 1) / 2;
      // What an odd version brought is seen from the next on, unless that brought something of its own.
      if (!left.empty() && left.back().version == version) {
        free_.push_back(left.back().slot);
        left.back().slot = entry.slot;
      } else {
        left.push_back({version, entry.slot});
      }
    }
    entries = std::move(left);
  }
}

std::size_t PageVersions::bytes() const {
  std::size_t entries = 0;
  for (const std::vector<Entry>& page : pages_) entries += page.capacity();
  return chunks_.size() * kSlotsInChunk * page_bytes_ + entries * sizeof(Entry) + pages_.size() * sizeof(pages_[0]);
}

void ArrayVersions::keep(Arrays arrays, std::uint32_t version) {
  if (versions_.empty())
    for (const std::span<std::byte>& array : arrays) {
      versions_.emplace_back(page_bytes_, (array.size() + page_bytes_ - 1) / page_bytes_);
      newest_.emplace_back(array.size());
    }
  for (std::size_t n = 0; n < arrays.size(); ++n) {
    assert(arrays[n].size() == newest_[n].size());
    for (std::size_t page = 0; page < versions_[n].pages(); ++page) {
      const std::size_t first = page * page_bytes_, size = std::min(page_bytes_, arrays[n].size() - first);
      if (std::memcmp(arrays[n].data() + first, newest_[n].data() + first, size) == 0) continue;
      std::memcpy(newest_[n].data() + first, arrays[n].data() + first, size);
      versions_[n].put(page, version, arrays[n].subspan(first, size));
    }
  }
}

void ArrayVersions::restore(Arrays arrays, std::uint32_t version) const {
  for (std::size_t n = 0; n < arrays.size(); ++n)
    for (std::size_t page = 0; page < versions_[n].pages(); ++page) {
      const std::size_t first = page * page_bytes_, size = std::min(page_bytes_, arrays[n].size() - first);
      const std::span<const std::byte> content = versions_[n].at(page, version);
      if (content.empty())
        std::memset(arrays[n].data() + first, 0, size);
      else
        std::memcpy(arrays[n].data() + first, content.data(), size);
    }
}

void ArrayVersions::halve() {
  for (PageVersions& one : versions_) one.halve();
}

std::size_t ArrayVersions::bytes() const {
  std::size_t all = 0;
  for (const PageVersions& one : versions_) all += one.bytes();
  for (const std::vector<std::byte>& copy : newest_) all += copy.size();
  return all;
}

}  // namespace app
