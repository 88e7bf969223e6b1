// One value per voxel, with a border of one voxel of air around the volume, so that samples from -1 to size need no
// special case. Fields of one grid share their strides. i fastest; voxel (0,0,0) is one row and one slice in. Padded
// behind the last value for wide loads. Plain data; memory: one T a voxel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace render {

/// Memory layout, counted in values.
struct FieldLayout {
  glm::ivec3 size{0};         ///< voxels without the border
  std::ptrdiff_t row = 0;     ///< from one j to the next
  std::ptrdiff_t slice = 0;   ///< from one k to the next
  std::ptrdiff_t origin = 0;  ///< of voxel (0,0,0)

  FieldLayout() = default;
  explicit FieldLayout(glm::ivec3 voxels)
      : size(voxels), row(voxels.x + 2), slice(row * (voxels.y + 2)), origin(slice + row + 1) {}

  /// ijk from -1 to size.
  std::ptrdiff_t offset(glm::ivec3 ijk) const { return origin + ijk.z * slice + ijk.y * row + ijk.x; }
  /// Values to allocate: a sample at the far border reads one slice, row and word further, with weight 0.
  std::size_t count() const { return static_cast<std::size_t>(slice * (size.z + 3) + row + 16); }
};

template <class T>
class BorderedField {
 public:
  BorderedField() = default;
  explicit BorderedField(glm::ivec3 size, T value = {}) : layout_(size), values_(layout_.count(), value) {}

  const FieldLayout& layout() const { return layout_; }
  const T* data() const { return values_.data(); }
  T* at(glm::ivec3 ijk) { return values_.data() + layout_.offset(ijk); }
  const T* at(glm::ivec3 ijk) const { return values_.data() + layout_.offset(ijk); }

 private:
  FieldLayout layout_;
  std::vector<T> values_;
};

/// Between the values around `at`, in voxels from -1 to the size.
inline float trilinear(const BorderedField<std::uint16_t>& field, const glm::vec3& at) {
  const glm::ivec3 low(glm::floor(at));
  const glm::vec3 part = at - glm::vec3(low);
  const std::uint16_t* const from = field.at(low);
  const auto row = [&](std::ptrdiff_t further) {
    return glm::mix(static_cast<float>(from[further]), static_cast<float>(from[further + 1]), part.x);
  };
  const std::ptrdiff_t j = field.layout().row, k = field.layout().slice;
  return glm::mix(glm::mix(row(0), row(j), part.y), glm::mix(row(k), row(k + j), part.y), part.z);
}

/// Size and index of an array without border, i fastest.
inline std::size_t countIn(glm::ivec3 size) {
  return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * static_cast<std::size_t>(size.z);
}
inline std::size_t indexIn(glm::ivec3 size, glm::ivec3 ijk) {
  return (static_cast<std::size_t>(ijk.z) * static_cast<std::size_t>(size.y) + static_cast<std::size_t>(ijk.y)) *
             static_cast<std::size_t>(size.x) +
         static_cast<std::size_t>(ijk.x);
}

/// A box of voxels.
struct VoxelBox {
  glm::ivec3 first{0}, extent{0};

  bool empty() const { return extent.x <= 0 || extent.y <= 0 || extent.z <= 0; }
  std::size_t count() const { return empty() ? 0 : countIn(extent); }
  bool operator==(const VoxelBox&) const = default;
};

inline VoxelBox boxAround(const VoxelBox& a, const VoxelBox& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  const glm::ivec3 low = glm::min(a.first, b.first);
  return {low, glm::max(a.first + a.extent, b.first + b.extent) - low};
}

/// Grown by `by` voxels on every side, clipped to a volume of `size`.
inline VoxelBox grown(const VoxelBox& box, int by, glm::ivec3 size) {
  const glm::ivec3 low = glm::max(box.first - by, glm::ivec3(0));
  return {low, glm::min(box.first + box.extent + by, size) - low};
}

/// Calls visit(ijk) for every voxel of the box, i fastest.
template <class Visit>
void forEachIn(const VoxelBox& box, const Visit& visit) {
  const glm::ivec3 end = box.first + box.extent;
  for (int k = box.first.z; k < end.z; ++k)
    for (int j = box.first.y; j < end.y; ++j)
      for (int i = box.first.x; i < end.x; ++i) visit(glm::ivec3(i, j, k));
}

}  // namespace render
