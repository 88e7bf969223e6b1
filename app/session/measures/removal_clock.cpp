#include "app/session/measures/removal_clock.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace app {
namespace {

/// Whether a place of frame T lies within `margin_mm` of the head.
bool isCovered(const haptics::BurShape& head, const glm::dvec3& q, double margin_mm) {
  const double r = std::hypot(q.x, q.y), half_mm = 0.5 * head.length_mm, reach_mm = head.radius_mm + margin_mm;
  switch (head.kind) {
    case haptics::ShapeKind::sphere:
      return glm::dot(q, q) <= reach_mm * reach_mm;
    case haptics::ShapeKind::capsule:
      return std::hypot(r, q.z - std::clamp(q.z, -half_mm, half_mm)) <= reach_mm;
    case haptics::ShapeKind::cylinder:
      return r <= reach_mm && std::abs(q.z) <= half_mm + margin_mm;
    case haptics::ShapeKind::revolved:
      return assets::outlineDistance_mm(haptics::revolvedOutline(head), r, q.z) <= margin_mm;
    case haptics::ShapeKind::cone:
      break;
  }
  const double share = std::clamp((q.z + half_mm) / std::max(head.length_mm, 1e-6), 0.0, 1.0);
  return r <= head.radius_mm * share + margin_mm && std::abs(q.z) <= half_mm + margin_mm;
}

}  // namespace

RemovalClock::RemovalClock(const assets::VolumeGrid& grid, std::span<const std::uint8_t> before,
                           std::span<const std::uint8_t> after)
    : grid_(grid) {
  assert(before.size() == grid.voxelCount() && after.size() == before.size());
  low_ = grid.size;
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (before[v] <= after[v]) return;
    removed_.push_back({ijk, v, (before[v] - after[v]) / 255.0, {}});
    low_ = glm::min(low_, ijk), end_ = glm::max(end_, ijk + 1);
  });
  if (removed_.empty()) return;
  place_.assign(assets::countIn(end_ - low_), -1);
  for (std::size_t n = 0; n < removed_.size(); ++n)
    place_[assets::indexIn(end_ - low_, removed_[n].ijk - low_)] = static_cast<std::int32_t>(n);
}

void RemovalClock::add(const haptics::Tick& tick, const haptics::Tool& tool) {
  if (place_.empty() || !tick.drilling || !tool.turns() || !(tick.removed_mm3 > 0.0) ||
      has(tick.faults, haptics::Fault::bad_pose))
    return;
  const double h = grid_.spacing_mm;
  const glm::dvec3 centre_P_mm = tick.proxy_P.mm;
  const glm::dquat rotation = tick.heldRotation();
  if (last_ && last_->head == tool.head) {
    const glm::dquat turn = rotation * glm::conjugate(last_->rotation);
    const double off_mm = glm::distance(centre_P_mm, last_->centre_P_mm) +
                          2.0 * glm::length(glm::dvec3(turn.x, turn.y, turn.z)) * haptics::halfHeight_mm(tool.head);
    if (off_mm < 0.25 * h) return;
  }
  last_ = Covered{centre_P_mm, rotation, tool.head};
  const double margin_mm = 0.5 * h;
  const glm::dvec3 axis = rotation * glm::dvec3(0.0, 0.0, 1.0);
  glm::dvec3 reach_mm(0.0);
  for (int n = 0; n < 3; ++n)
    reach_mm[n] = margin_mm + std::max(haptics::reach_mm(tool.head, axis[n]), haptics::reach_mm(tool.head, -axis[n]));
  const glm::ivec3 first = glm::max(low_, glm::ivec3(glm::ceil(grid_.indexFromPoint(centre_P_mm - reach_mm))));
  const glm::ivec3 end = glm::min(end_, glm::ivec3(glm::floor(grid_.indexFromPoint(centre_P_mm + reach_mm))) + 1);
  const glm::dquat into_T = glm::conjugate(rotation);
  assets::forVoxels(first, end, [&](glm::ivec3 ijk) {
    const std::int32_t n = place_[assets::indexIn(end_ - low_, ijk - low_)];
    if (n < 0) return;
    RemovedVoxel& voxel = removed_[static_cast<std::size_t>(n)];
    if (!voxel.t_s && isCovered(tool.head, into_T * (grid_.centre_P_mm(ijk) - centre_P_mm), margin_mm))
      voxel.t_s = tick.t_s;
  });
}

}  // namespace app
