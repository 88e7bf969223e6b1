#include "render/volume/smooth_field.h"

#include <algorithm>
#include <array>

namespace render {
namespace {

constexpr std::array<std::uint32_t, 5> kBinomial{1, 4, 6, 4, 1};  // sum 16

std::size_t product(int a, int b, int c) {
  return static_cast<std::size_t>(a) * static_cast<std::size_t>(b) * static_cast<std::size_t>(c);
}

// One axis: `rows` rows of `length` inner steps, each step `stride` apart and `stride` values wide; input is four
// longer.
std::vector<std::uint32_t> alongAxis(const std::vector<std::uint32_t>& in, std::size_t rows, std::size_t length,
                                     std::size_t stride) {
  std::vector<std::uint32_t> out(rows * length * stride, 0);
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t step = 0; step < length; ++step) {
      std::uint32_t* const to = &out[(row * length + step) * stride];
      for (std::size_t tap = 0; tap < kBinomial.size(); ++tap) {
        const std::uint32_t* const from = &in[(row * (length + 4) + step + tap) * stride];
        for (std::size_t n = 0; n < stride; ++n) to[n] += kBinomial[tap] * from[n];
      }
    }
  return out;
}

}  // namespace

std::vector<std::uint16_t> smoothed(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid,
                                    glm::ivec3 first, glm::ivec3 extent) {
  // The box with its border, air outside the volume.
  const glm::ivec3 wide = extent + 2 * kSmoothReach;
  std::vector<std::uint32_t> box(product(wide.x, wide.y, wide.z), 0);
  const glm::ivec3 low = glm::max(first - kSmoothReach, glm::ivec3(0));
  const glm::ivec3 high = glm::min(first + extent + kSmoothReach, grid.size);
  for (int k = low.z; k < high.z; ++k)
    for (int j = low.y; j < high.y; ++j) {
      const auto row = solid.begin() + static_cast<std::ptrdiff_t>(grid.index({low.x, j, k}));
      const glm::ivec3 at = glm::ivec3(low.x, j, k) - first + kSmoothReach;
      std::copy(
          row, row + (high.x - low.x),
          box.begin() + static_cast<std::ptrdiff_t>(product(wide.x, wide.y, at.z) + product(wide.x, at.y, 1)) + at.x);
    }

  // z, y, x; then 255 * 16^3 becomes 65535.
  box = alongAxis(box, 1, static_cast<std::size_t>(extent.z), product(wide.x, wide.y, 1));
  box = alongAxis(box, static_cast<std::size_t>(extent.z), static_cast<std::size_t>(extent.y), product(wide.x, 1, 1));
  box = alongAxis(box, product(extent.y, extent.z, 1), static_cast<std::size_t>(extent.x), 1);
  std::vector<std::uint16_t> values(box.size());
  std::ranges::transform(box, values.begin(),
                         [](std::uint32_t sum) { return static_cast<std::uint16_t>((sum * 257u) >> 12); });
  return values;
}

}  // namespace render
