#include "app/check_page/label_bricks.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "app/check_page/jaw_views.h"

namespace app {
namespace {

constexpr std::uint8_t kNowhere = 255;

std::uint8_t further(std::uint8_t distance) {
  return distance == kNowhere ? kNowhere : static_cast<std::uint8_t>(std::min(distance + 1, kNowhere - 1));
}

/// The least of a row's element and its neighbours.
void leastOfThree(const std::uint8_t* row, int count, std::uint8_t* out) {
  for (int i = 0; i < count; ++i) out[i] = std::min({row[std::max(i - 1, 0)], row[i], row[std::min(i + 1, count - 1)]});
}

void takeFurther(const std::uint8_t* from, int count, std::uint8_t* row) {
  for (int i = 0; i < count; ++i) row[i] = std::min(row[i], further(from[i]));
}

/// Both ways through `count` of them: step(n, the one before n).
template <class Step>
void bothWays(int count, const Step& step) {
  for (int n = 1; n < count; ++n) step(n, n - 1);
  for (int n = count - 2; n >= 0; --n) step(n, n + 1);
}

/// The distance by the farthest axis, exact: a way along one axis, then along two at once, then along three.
void measure(const glm::ivec3& size, std::vector<std::uint8_t>& distance) {
  const auto row_at = [&](int j, int k) { return distance.data() + assets::indexIn(size, {0, j, k}); };
  tbb::parallel_for(0, size.z, [&](int k) {
    std::vector<std::uint8_t> near(static_cast<std::size_t>(size.x));
    for (int j = 0; j < size.y; ++j) {
      std::uint8_t* const row = row_at(j, k);
      bothWays(size.x, [row](int i, int before) { row[i] = std::min(row[i], further(row[before])); });
    }
    bothWays(size.y, [&](int j, int before) {
      leastOfThree(row_at(before, k), size.x, near.data());
      takeFurther(near.data(), size.x, row_at(j, k));
    });
  });
  std::vector<std::uint8_t> near(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
  const auto near_row = [&](int j) { return near.data() + static_cast<std::ptrdiff_t>(j) * size.x; };
  bothWays(size.z, [&](int k, int before) {
    for (int j = 0; j < size.y; ++j) leastOfThree(row_at(j, before), size.x, near_row(j));
    for (int j = 0; j < size.y; ++j)
      for (int of = std::max(j - 1, 0); of <= std::min(j + 1, size.y - 1); ++of)
        takeFurther(near_row(of), size.x, row_at(j, k));
  });
}

}  // namespace

void LabelBricks::find(const assets::VolumeGrid& grid, const std::vector<std::uint8_t>& what) {
  size_ = (grid.size + (kEdge - 1)) / kEdge;
  for (std::vector<std::uint8_t>& distance : distance_) distance.assign(assets::countIn(size_), kNowhere);
  // Nothing is shared between layers of bricks.
  tbb::parallel_for(0, size_.z, [&](int layer) {
    const int end = std::min(grid.size.z, kEdge * (layer + 1));
    for (int k = kEdge * layer; k < end; ++k)
      for (int j = 0; j < grid.size.y; ++j) {
        const std::uint8_t* const row = what.data() + grid.index({0, j, k});
        const std::size_t first = assets::indexIn(size_, {0, j / kEdge, layer});
        for (int i = 0; i < grid.size.x; ++i) {
          if (row[i] == 0) continue;
          const std::size_t brick = first + static_cast<std::size_t>(i / kEdge);
          distance_[bone_or_tooth][brick] = 0;
          if (row[i] != kBoneVoxel) distance_[tooth_alone][brick] = 0;
        }
      }
  });
  for (std::vector<std::uint8_t>& distance : distance_) measure(size_, distance);
}

void LabelBricks::add(const glm::ivec3& ijk, std::uint8_t what) {
  if (what == 0) return;
  fill(ijk / kEdge, bone_or_tooth);
  if (what != kBoneVoxel) fill(ijk / kEdge, tooth_alone);
}

// Outwards until a whole shell is nearer to others: then all beyond it are.
void LabelBricks::fill(const glm::ivec3& brick, Wanted wanted) {
  std::vector<std::uint8_t>& distance = distance_[wanted];
  for (int away = 0; away < kNowhere - 1; ++away) {
    bool is_nearer = false;
    const glm::ivec3 low = glm::max(brick - away, glm::ivec3(0)), end = glm::min(brick + away + 1, size_);
    assets::forVoxels(low, end, [&](glm::ivec3 at) {
      const glm::ivec3 off = glm::abs(at - brick);
      std::uint8_t& here = distance[assets::indexIn(size_, at)];
      if (std::max({off.x, off.y, off.z}) != away || here <= away) return;
      here = static_cast<std::uint8_t>(away);
      is_nearer = true;
    });
    if (!is_nearer) return;
  }
}

}  // namespace app
