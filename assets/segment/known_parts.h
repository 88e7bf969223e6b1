// What was made of a tooth, kept by what it was made of: a click on one tooth makes that one anew and no other, and
// what is undone is there still. The cells of the tooth's box decide, all of them. Plain values; any one thread; a
// compare of the cells.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <utility>
#include <vector>

#include "assets/segment/cell_masks.h"

namespace assets {

template <class Made>
class KnownParts {
 public:
  static constexpr std::size_t kMost = 96;  ///< a jaw's teeth as they were after the last clicks

  /// Null: it is not known. Until the next keep().
  const Made* find(const CellBox& box, const std::vector<std::uint8_t>& cells) {
    const auto found =
        std::ranges::find_if(parts_, [&](const Part& part) { return part.box == box && part.cells == cells; });
    if (found == parts_.end()) return nullptr;
    std::rotate(parts_.begin(), found, found + 1);
    return &parts_.front().made;
  }
  void keep(const CellBox& box, std::vector<std::uint8_t> cells, Made made) {
    parts_.push_front({box, std::move(cells), std::move(made)});
    if (parts_.size() > kMost) parts_.pop_back();
  }

 private:
  struct Part {
    CellBox box;
    std::vector<std::uint8_t> cells;
    Made made;
  };
  std::deque<Part> parts_;  ///< the last ones first
};

}  // namespace assets
