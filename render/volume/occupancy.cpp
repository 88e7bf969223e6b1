#include "render/volume/occupancy.h"

#include <tbb/parallel_for.h>

#include <utility>

#include "render/shaders/shared_constants.glsl"

namespace render {

static_assert(BRICK_VOXELS == assets::kBrickVoxels);

Occupancy::Occupancy(glm::ivec3 bricks, int edge, MarkOf mark_of)
    : bricks_(bricks),
      edge_(edge),
      mark_of_(std::move(mark_of)),
      marks_(countIn(bricks)),
      emptiness_(marks_.size()),
      is_touched_(marks_.size()) {
  tbb::parallel_for(0, bricks.z, [this](int k) {
    forEachIn({{0, 0, k}, {bricks_.x, bricks_.y, 1}},
              [this](glm::ivec3 brick) { marks_[indexIn(bricks_, brick)] = mark_of_(brick); });
  });
  rebuild();
}

void Occupancy::touch(const VoxelBox& box) {
  // Every brick that the box or its border of one value overlaps.
  const glm::ivec3 low = glm::max((box.first - 1) / edge_, glm::ivec3(0));
  const glm::ivec3 high = glm::min((box.first + box.extent) / edge_, bricks_ - 1);
  forEachIn({low, high - low + 1}, [this](glm::ivec3 brick) {
    if (std::exchange(is_touched_[indexIn(bricks_, brick)], std::uint8_t{1}) == 0) touched_.push_back(brick);
  });
}

bool Occupancy::refresh() {
  bool filled = false;
  for (const glm::ivec3& brick : touched_) {
    const std::size_t index = indexIn(bricks_, brick);
    const bool was_solid = marks_[index] != 0;
    marks_[index] = mark_of_(brick);
    const bool is_solid = marks_[index] != 0;
    filled = filled || (is_solid && !was_solid);
    stale_ = stale_ || is_solid != was_solid;
    is_touched_[index] = 0;
  }
  touched_.clear();
  if (filled) rebuild();
  return filled;
}

bool Occupancy::rebuildIfStale() {
  const bool changed = refresh();
  if (!stale_) return changed;
  rebuild();
  return true;
}

// Chebyshev distance transform, axis by axis: the minimum along a line of max(offset, distance so far).
void Occupancy::rebuild() {
  stale_ = false;
  std::ranges::transform(marks_, emptiness_.begin(), [](std::uint8_t mark) { return mark != 0 ? 0 : kFarthest; });
  std::size_t stride = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<std::uint8_t> before = emptiness_;
    const std::size_t block = stride * static_cast<std::size_t>(bricks_[axis]);
    for (std::uint8_t away = 1; away < std::min<int>(kFarthest, bricks_[axis]); ++away)
      for (std::size_t first = 0; first < before.size(); first += block) {
        const std::size_t shift = away * stride, count = block - shift;
        const std::uint8_t* const from = &before[first];
        std::uint8_t* const to = &emptiness_[first];
        for (std::size_t n = 0; n < count; ++n) to[n] = std::min(to[n], std::max(away, from[n + shift]));
        for (std::size_t n = 0; n < count; ++n) to[n + shift] = std::min(to[n + shift], std::max(away, from[n]));
      }
    stride = block;
  }
}

}  // namespace render
