#include "render/volume/brick_distance.h"

#include <algorithm>
#include <vector>

namespace render {
namespace {

/// One bit per brick, rows of whole words.
class BrickBits {
 public:
  explicit BrickBits(glm::ivec3 size)
      : size_(size),
        row_(static_cast<std::size_t>(size.x + 63) / 64),
        bits_(row_ * static_cast<std::size_t>(size.y) * static_cast<std::size_t>(size.z)) {}

  void set(int i, int j, int k) { bits_[at(j, k) + static_cast<std::size_t>(i) / 64] |= std::uint64_t{1} << (i % 64); }

  /// Grows by one brick in every direction, corners included; calls found(index) for each new one. False: none.
  template <class Found>
  bool grow(Found found) {
    const std::vector<std::uint64_t> before = bits_;
    for (std::size_t first = 0; first < bits_.size(); first += row_)
      for (std::size_t w = 0; w < row_; ++w) {
        const std::uint64_t word = before[first + w];
        const std::uint64_t left = w > 0 ? before[first + w - 1] >> 63 : 0;
        const std::uint64_t right = w + 1 < row_ ? before[first + w + 1] << 63 : 0;
        bits_[first + w] = word | (word << 1) | (word >> 1) | left | right;
      }
    growAcross(row_, static_cast<std::size_t>(size_.y), static_cast<std::size_t>(size_.z));
    growAcross(row_ * static_cast<std::size_t>(size_.y), static_cast<std::size_t>(size_.z), 1);

    bool is_new = false;
    for (int k = 0; k < size_.z; ++k)
      for (int j = 0; j < size_.y; ++j)
        for (std::size_t w = 0; w < row_; ++w) {
          std::uint64_t fresh = bits_[at(j, k) + w] & ~before[at(j, k) + w];
          for (; fresh != 0; fresh &= fresh - 1)
            if (const int i = static_cast<int>(w) * 64 + __builtin_ctzll(fresh); i < size_.x) {
              found((static_cast<std::size_t>(k) * static_cast<std::size_t>(size_.y) + static_cast<std::size_t>(j)) *
                        static_cast<std::size_t>(size_.x) +
                    static_cast<std::size_t>(i));
              is_new = true;
            }
        }
    return is_new;
  }

 private:
  std::size_t at(int j, int k) const {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(size_.y) + static_cast<std::size_t>(j)) * row_;
  }
  /// Ors each of `steps` runs of `width` words with the runs before and behind it, in each of `sheets` sheets.
  void growAcross(std::size_t width, std::size_t steps, std::size_t sheets) {
    const std::vector<std::uint64_t> before = bits_;
    for (std::size_t sheet = 0; sheet < sheets; ++sheet)
      for (std::size_t step = 0; step < steps; ++step) {
        const std::size_t here = (sheet * steps + step) * width;
        for (std::size_t w = 0; w < width; ++w) {
          if (step > 0) bits_[here + w] |= before[here + w - width];
          if (step + 1 < steps) bits_[here + w] |= before[here + w + width];
        }
      }
  }

  glm::ivec3 size_;
  std::size_t row_;
  std::vector<std::uint64_t> bits_;
};

}  // namespace

void distancesInBricks(glm::ivec3 size, std::span<const std::uint8_t> marked, int farthest,
                       std::span<std::uint8_t> distance) {
  BrickBits near(size);
  std::size_t b = 0;
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i, ++b) {
        distance[b] = static_cast<std::uint8_t>(marked[b] != 0 ? 0 : farthest);
        if (marked[b] != 0) near.set(i, j, k);
      }
  for (int away = 1; away < farthest; ++away)
    if (!near.grow([&](std::size_t found) { distance[found] = static_cast<std::uint8_t>(away); })) break;
}

}  // namespace render
