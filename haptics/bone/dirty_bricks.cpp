#include "haptics/bone/dirty_bricks.h"

#include <bit>

namespace haptics {
namespace {

std::size_t brickCount(glm::ivec3 bricks) {
  return static_cast<std::size_t>(bricks.x) * static_cast<std::size_t>(bricks.y) * static_cast<std::size_t>(bricks.z);
}

}  // namespace

DirtyBricks::DirtyBricks(glm::ivec3 bricks)
    : bricks_(bricks),
      words_((brickCount(bricks) + 63) / 64),
      bits_(std::make_unique<std::atomic<std::uint64_t>[]>(words_)) {}

void DirtyBricks::mark(glm::ivec3 brick) {
  const auto nx = static_cast<std::size_t>(bricks_.x), ny = static_cast<std::size_t>(bricks_.y);
  const std::size_t bit = (static_cast<std::size_t>(brick.z) * ny + static_cast<std::size_t>(brick.y)) * nx +
                          static_cast<std::size_t>(brick.x);
  bits_[bit / 64].fetch_or(std::uint64_t{1} << (bit % 64), std::memory_order_release);
}

void DirtyBricks::takeInto(std::vector<glm::ivec3>& out) {
  const auto nx = static_cast<std::size_t>(bricks_.x), ny = static_cast<std::size_t>(bricks_.y);
  for (std::size_t word = 0; word < words_; ++word) {
    if (bits_[word].load(std::memory_order_relaxed) == 0) continue;
    std::uint64_t taken = bits_[word].exchange(0, std::memory_order_acquire);
    for (; taken != 0; taken &= taken - 1) {
      const std::size_t bit = word * 64 + static_cast<std::size_t>(std::countr_zero(taken));
      out.emplace_back(static_cast<int>(bit % nx), static_cast<int>(bit / nx % ny), static_cast<int>(bit / nx / ny));
    }
  }
}

}  // namespace haptics
