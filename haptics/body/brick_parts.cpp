#include "haptics/body/brick_parts.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>

namespace haptics {
namespace {

constexpr int kBrickEdge = assets::kBrickVoxels;
constexpr std::uint64_t kFirstColumn = 0x0101010101010101u, kLastColumn = kFirstColumn << 7;

/// Of a row of eight voxels: how many there are, sum and sum of squares of their index.
struct RowSums {
  std::int32_t count = 0, sum = 0, squares = 0;
};

constexpr std::array<RowSums, 256> kRows = [] {
  std::array<RowSums, 256> rows{};
  for (unsigned row = 0; row < rows.size(); ++row)
    for (int i = 0; i < kBrickEdge; ++i) {
      if ((row >> i & 1u) == 0) continue;
      rows[row].count += 1;
      rows[row].sum += i;
      rows[row].squares += i * i;
    }
  return rows;
}();

VoxelMoments momentsOf(const BrickMask& mask, glm::ivec3 corner) {
  RowSums all;
  std::int32_t y = 0, z = 0, yy = 0, zz = 0, yz = 0, xz = 0, xy = 0;
  for (int k = 0; k < kBrickEdge; ++k) {
    RowSums layer;
    std::int32_t layer_y = 0;
    std::uint64_t word = mask[static_cast<std::size_t>(k)];
    for (int j = 0; word != 0; ++j, word >>= kBrickEdge) {
      const RowSums& row = kRows[word & 0xff];
      layer.count += row.count;
      layer.sum += row.sum;
      layer.squares += row.squares;
      layer_y += j * row.count;
      yy += j * j * row.count;
      xy += j * row.sum;
    }
    all.count += layer.count;
    all.sum += layer.sum;
    all.squares += layer.squares;
    y += layer_y;
    z += k * layer.count;
    zz += k * k * layer.count;
    yz += k * layer_y;
    xz += k * layer.sum;
  }
  // From the brick's corner to the grid's.
  const WholeVector o(corner), sum(all.sum, y, z);
  const std::int64_t n = all.count;
  return {n, sum + n * o, WholeVector(all.squares, yy, zz) + std::int64_t{2} * o * sum + n * o * o,
          WholeVector(yz + o.y * sum.z + o.z * sum.y + n * o.y * o.z, xz + o.x * sum.z + o.z * sum.x + n * o.x * o.z,
                      xy + o.x * sum.y + o.y * sum.x + n * o.x * o.y)};
}

/// Takes the part of the first voxel out of `left`, which is not empty.
BrickMask takePart(BrickMask& left) {
  BrickMask part{};
  for (std::size_t k = 0; k < left.size(); ++k)
    if (left[k] != 0) {
      part[k] = left[k] & -left[k];
      break;
    }
  const auto grow_layer = [&](std::size_t k) {
    std::uint64_t layer = part[k];
    if (k > 0) layer |= part[k - 1];
    if (k + 1 < part.size()) layer |= part[k + 1];
    layer &= left[k];
    for (std::uint64_t before = 0; before != layer;) {
      before = layer;
      layer |= (layer << 1 & ~kFirstColumn) | (layer >> 1 & ~kLastColumn) | layer << kBrickEdge | layer >> kBrickEdge;
      layer &= left[k];
    }
    const bool grew = layer != part[k];
    part[k] = layer;
    return grew;
  };
  for (bool grew = true; grew;) {
    grew = false;
    for (std::size_t k = 0; k < part.size(); ++k) grew |= grow_layer(k);
    for (std::size_t k = part.size(); k-- > 0;) grew |= grow_layer(k);
  }
  for (std::size_t k = 0; k < left.size(); ++k) left[k] &= ~part[k];
  return part;
}

/// Whether `a` touches `b`, which lies in the next brick along this axis.
bool touches(const BrickMask& a, const BrickMask& b, int axis) {
  if (axis == 2) return (a.back() & b.front()) != 0;
  std::uint64_t shared = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    shared |= axis == 0 ? (a[k] >> 7) & b[k] & kFirstColumn : (a[k] >> 56) & b[k] & 0xff;
  return shared != 0;
}

}  // namespace

VoxelMoments& VoxelMoments::operator+=(const VoxelMoments& other) {
  count += other.count;
  sum += other.sum;
  squares += other.squares;
  products += other.products;
  return *this;
}

BrickMask solidMask(std::span<const std::uint8_t, 512> solid) {
  // The highest bit of eight bytes, gathered by one product.
  static_assert(std::endian::native == std::endian::little);
  BrickMask mask{};
  for (std::size_t row = 0; row < 64; ++row) {
    std::uint64_t bytes = 0;
    std::memcpy(&bytes, solid.data() + row * 8, 8);
    mask[row / 8] |= ((bytes >> 7 & kFirstColumn) * 0x0102040810204080u >> 56) << (row % 8 * 8);
  }
  return mask;
}

void findParts(const BrickMask& mask, glm::ivec3 corner, std::vector<BrickPart>& out) {
  out.clear();
  for (BrickMask left = mask; !isEmpty(left);) {
    const BrickMask part = takePart(left);
    out.push_back({part, momentsOf(part, corner)});
  }
}

std::uint32_t PartJoin::find(std::uint32_t part) {
  while (root_[part] != part) part = root_[part] = root_[root_[part]];
  return part;
}

void PartJoin::link(std::size_t a, std::size_t b) {
  const std::uint32_t root_a = find(static_cast<std::uint32_t>(a)), root_b = find(static_cast<std::uint32_t>(b));
  root_[std::max(root_a, root_b)] = std::min(root_a, root_b);
}

void PartJoin::unite(glm::ivec3 bricks, std::span<const std::vector<BrickPart>> parts) {
  assert(parts.size() == assets::countIn(bricks));
  first_.resize(parts.size());
  std::uint32_t count = 0;
  for (std::size_t brick = 0; brick < parts.size(); ++brick) {
    first_[brick] = count;
    count += static_cast<std::uint32_t>(parts[brick].size());
  }
  root_.resize(count);
  for (std::uint32_t part = 0; part < count; ++part) root_[part] = part;

  const std::array<std::size_t, 3> step{1, static_cast<std::size_t>(bricks.x),
                                        static_cast<std::size_t>(bricks.x) * static_cast<std::size_t>(bricks.y)};
  std::size_t brick = 0;
  assets::forVoxels(glm::ivec3(0), bricks, [&](glm::ivec3 at) {
    const std::size_t here = brick++;
    if (parts[here].empty()) return;
    for (int axis = 0; axis < 3; ++axis) {
      if (at[axis] + 1 == bricks[axis]) continue;
      const std::size_t next = here + step[static_cast<std::size_t>(axis)];
      for (std::size_t a = 0; a < parts[here].size(); ++a)
        for (std::size_t b = 0; b < parts[next].size(); ++b)
          if (touches(parts[here][a].mask, parts[next][b].mask, axis)) link(first_[here] + a, first_[next] + b);
    }
  });
  // Parents have smaller numbers, so one pass reaches every root.
  for (std::uint32_t part = 0; part < count; ++part) root_[part] = root_[root_[part]];
}

}  // namespace haptics
