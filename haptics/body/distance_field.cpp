#include "haptics/body/distance_field.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "assets/ct_volume.h"

namespace haptics {
namespace {

bool isSolid(std::uint8_t byte) { return byte >= assets::kHalfSolid; }

/// The distance t of a voxel whose nearest known neighbours along the axes are this far: the least solution of
/// sum max(t - d, 0)^2 = edge^2.
float distanceFrom(std::array<float, 3> d_mm, float edge_mm) {
  if (d_mm[0] > d_mm[1]) std::swap(d_mm[0], d_mm[1]);
  if (d_mm[1] > d_mm[2]) std::swap(d_mm[1], d_mm[2]);
  if (d_mm[0] > d_mm[1]) std::swap(d_mm[0], d_mm[1]);
  const auto [a, b, c] = d_mm;
  const float one = a + edge_mm;
  if (one <= b) return one;
  const float two = 0.5F * (a + b + std::sqrt(std::max(0.0F, 2.0F * edge_mm * edge_mm - (a - b) * (a - b))));
  if (two <= c) return two;
  const float sum = a + b + c, squares = a * a + b * b + c * c;
  return (sum + std::sqrt(std::max(0.0F, sum * sum - 3.0F * (squares - edge_mm * edge_mm)))) / 3.0F;
}

}  // namespace

DistanceField::DistanceField(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid, double band_mm,
                             const std::stop_token& stop)
    : grid_(grid),
      last_(grid.size - 1),
      band_mm_(static_cast<float>(band_mm)),
      distance_mm_(grid.voxelCount(), band_mm_) {
  assert(solid.size() == grid.voxelCount());
  std::vector<Voxel> state(solid.size(), Voxel::settled);
  startAtCrossings(solid, state);
  for (int n = 0; n < 8 && !stop.stop_requested(); ++n) sweep(state, solid, 1 - 2 * assets::cornerOffset(n));
  for (std::size_t v = 0; v < solid.size(); ++v)
    if (isSolid(solid[v])) distance_mm_[v] = -distance_mm_[v];
}

/// Where a neighbour lies on the other side, the plane through the crossings of one half along the axes.
void DistanceField::startAtCrossings(std::span<const std::uint8_t> solid, std::vector<Voxel>& state) {
  constexpr float kHalf = 127.5F;
  const std::array<std::size_t, 3> stride = {1, assets::indexIn(grid_.size, {0, 1, 0}),
                                             assets::indexIn(grid_.size, {0, 0, 1})};
  assets::forVoxels(grid_, [&](glm::ivec3 ijk, std::size_t v) {
    const float here = static_cast<float>(solid[v]) - kHalf;
    float inverse_squares = 0.0F;
    for (int axis = 0; axis < 3; ++axis) {
      float nearest = 2.0F;  // in voxels; crossings lie within one
      const auto look = [&](std::size_t beside) {
        const float there = static_cast<float>(solid[beside]) - kHalf;
        if ((there > 0.0F) != (here > 0.0F)) nearest = std::min(nearest, here / (here - there));
      };
      const std::size_t step = stride[static_cast<std::size_t>(axis)];
      if (ijk[axis] > 0) look(v - step);
      if (ijk[axis] + 1 < grid_.size[axis]) look(v + step);
      if (nearest < 2.0F) inverse_squares += 1.0F / (nearest * nearest + 1e-6F);
    }
    if (inverse_squares == 0.0F) return;
    distance_mm_[v] = static_cast<float>(grid_.spacing_mm) / std::sqrt(inverse_squares);
    state[v] = Voxel::fixed;
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t step = stride[static_cast<std::size_t>(axis)];
      if (ijk[axis] > 0 && state[v - step] == Voxel::settled) state[v - step] = Voxel::open;
      if (ijk[axis] + 1 < grid_.size[axis] && state[v + step] == Voxel::settled) state[v + step] = Voxel::open;
    }
  });
}

/// One pass in a diagonal direction; a value spreads on its own side of the surface alone. Only where a neighbour has
/// changed since: what it finds is what a pass over all finds (locking, Bak et al., SIAM J. Sci. Comput. 32, 2010).
void DistanceField::sweep(std::vector<Voxel>& state, std::span<const std::uint8_t> solid, glm::ivec3 direction) {
  const float edge_mm = static_cast<float>(grid_.spacing_mm);
  const std::array<std::size_t, 3> stride = {1, assets::indexIn(grid_.size, {0, 1, 0}),
                                             assets::indexIn(grid_.size, {0, 0, 1})};
  const auto update = [&](glm::ivec3 ijk, std::size_t v) {
    state[v] = Voxel::settled;
    const bool inside = isSolid(solid[v]);
    std::array<float, 3> nearest_mm{};
    std::array<std::size_t, 6> beside{};
    std::size_t besides = 0;
    for (int axis = 0; axis < 3; ++axis) {
      float& least_mm = nearest_mm[static_cast<std::size_t>(axis)] = band_mm_;
      const std::size_t step = stride[static_cast<std::size_t>(axis)];
      const auto look = [&](std::size_t there) {
        if (isSolid(solid[there]) != inside) return;
        least_mm = std::min(least_mm, distance_mm_[there]);
        beside[besides++] = there;
      };
      if (ijk[axis] > 0) look(v - step);
      if (ijk[axis] + 1 < grid_.size[axis]) look(v + step);
    }
    if (std::min({nearest_mm[0], nearest_mm[1], nearest_mm[2]}) >= band_mm_) return;
    const float mm = distanceFrom(nearest_mm, edge_mm);
    if (mm >= distance_mm_[v]) return;
    distance_mm_[v] = mm;
    for (std::size_t n = 0; n < besides; ++n)
      if (state[beside[n]] == Voxel::settled) state[beside[n]] = Voxel::open;
  };
  for (int down = 0; down < grid_.size.z; ++down)
    for (int across = 0; across < grid_.size.y; ++across) {
      const int k = direction.z > 0 ? down : grid_.size.z - 1 - down;
      const int j = direction.y > 0 ? across : grid_.size.y - 1 - across;
      const std::size_t row = grid_.index({0, j, k});
      for (int along = 0; along < grid_.size.x; ++along) {
        const int i = direction.x > 0 ? along : grid_.size.x - 1 - along;
        const std::size_t v = row + static_cast<std::size_t>(i);
        if (state[v] == Voxel::open) update({i, j, k}, v);
      }
    }
}

DistanceField::Sample DistanceField::at(glm::vec3 index) const {
  index = glm::clamp(index, glm::vec3(0.0F), last_);
  const glm::ivec3 low = glm::clamp(glm::ivec3(index), glm::ivec3(0), glm::max(grid_.size - 2, 0));
  const glm::ivec3 next = glm::min(glm::ivec3(1), grid_.size - 1 - low);
  const glm::vec3 f = index - glm::vec3(low);
  const auto value = [&](int i, int j, int k) { return distance_mm_[grid_.index(low + next * glm::ivec3(i, j, k))]; };
  const float x00 = value(0, 0, 0), x01 = value(0, 0, 1), x10 = value(0, 1, 0), x11 = value(0, 1, 1);
  const float d00 = value(1, 0, 0) - x00, d01 = value(1, 0, 1) - x01, d10 = value(1, 1, 0) - x10,
              d11 = value(1, 1, 1) - x11;
  const float y00 = x00 + f.x * d00, y01 = x01 + f.x * d01, y10 = x10 + f.x * d10, y11 = x11 + f.x * d11;
  const float z0 = y00 + f.y * (y10 - y00), z1 = y01 + f.y * (y11 - y01);
  const float dx0 = d00 + f.y * (d10 - d00), dx1 = d01 + f.y * (d11 - d01);
  const glm::vec3 slope(dx0 + f.z * (dx1 - dx0), (y10 - y00) + f.z * ((y11 - y01) - (y10 - y00)), z1 - z0);
  return {z0 + f.z * (z1 - z0), slope / static_cast<float>(grid_.spacing_mm)};
}

}  // namespace haptics
