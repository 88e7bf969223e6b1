#include "haptics/bone/carve.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "haptics/bone/ball_rows.h"
#include "haptics/bone/voxel_sphere.h"

namespace haptics {
namespace {

/// What a fully covered voxel of each tissue loses in this step.
std::array<double, assets::kTissueCount> fullLoss(const ErosionParameters& erosion, double dt_s) {
  std::array<double, assets::kTissueCount> loss{};
  for (std::size_t label = 0; label < loss.size(); ++label) {
    const double wanted = erosion.removal_rate_per_s * erosion.tissue_factor[label] * dt_s;
    loss[label] = std::isfinite(wanted) ? std::clamp(wanted, 0.0, 1.0) : 0.0;
  }
  return loss;
}

/// Carves rows and remembers which bricks changed, so that each brick is marked once, after its voxels are stored.
class Cutter {
 public:
  Cutter(CarvedBone& bone, const BallRows& ball, const std::array<double, assets::kTissueCount>& loss,
         std::uint64_t tick)
      : bone_(bone), solid_(bone.solid()), ball_(ball), loss_(loss), tick_(tick) {}

  void cutRow(const BallRow& row, int j, int k) {
    const std::size_t start = bone_.grid().index({0, j, k});
    const double across2 = row.dy * row.dy + row.dz * row.dz;
    cutShell(start, row.outer_first, row.inner_first - 1, across2);
    for (int i = row.inner_first; i <= row.inner_last;) {
      // Most of a bur is in air or in the hole it has cut: eight voxels at a look.
      if (i + 7 <= row.inner_last && allAir(start + static_cast<std::size_t>(i))) {
        i += 8;
        continue;
      }
      const int end = std::min(i + 7, row.inner_last);
      for (; i <= end; ++i)
        if (solid_[start + static_cast<std::size_t>(i)] != 0) cutVoxel(start, i, 1.0);
    }
    cutShell(start, row.inner_last + 1, row.outer_last, across2);
  }

  /// Publishes the changed bricks of one row of bricks.
  void markBricks(int brick_j, int brick_k) {
    for (int b = 0; changed_first_ + b <= changed_last_; ++b)
      bone_.dirtyBricks().mark({changed_first_ + b, brick_j, brick_k});
    changed_first_ = 1 << 30;
    changed_last_ = -1;
  }

  CarveResult result() const {
    CarveResult result;
    const double step_mm3 = bone_.grid().voxelVolume_mm3() / 255.0;
    std::int64_t total = 0;
    for (std::size_t label = 0; label < steps_.size(); ++label) {
      total += steps_[label];
      result.removed_mm3_by_label[label] = static_cast<double>(steps_[label]) * step_mm3;
    }
    result.removed_mm3 = static_cast<double>(total) * step_mm3;
    return result;
  }

 private:
  bool allAir(std::size_t eight) const {
    std::uint64_t bytes;
    std::memcpy(&bytes, solid_.data() + eight, sizeof bytes);
    return bytes == 0;
  }

  void cutShell(std::size_t start, int first, int last, double across2) {
    for (int i = first; i <= last; ++i) {
      if (solid_[start + static_cast<std::size_t>(i)] == 0) continue;
      const double dx = i - ball_.centre.x;
      cutVoxel(start, i, lensOfSpheres(ball_.radius, kVoxelSphereRadius, std::sqrt(dx * dx + across2)).volume);
    }
  }

  void cutVoxel(std::size_t start, int i, double coverage) {
    const std::size_t voxel = start + static_cast<std::size_t>(i);
    const std::uint8_t label = bone_.label(voxel);
    const std::size_t tissue = label < assets::kTissueCount ? label : 0;
    const int removed = bone_.remove(voxel, coverage, coverage * loss_[tissue], tick_);
    if (removed == 0) return;
    steps_[tissue] += removed;
    changed_first_ = std::min(changed_first_, i / assets::kBrickVoxels);
    changed_last_ = std::max(changed_last_, i / assets::kBrickVoxels);
  }

  CarvedBone& bone_;
  std::span<const std::uint8_t> solid_;
  const BallRows& ball_;
  const std::array<double, assets::kTissueCount>& loss_;
  std::uint64_t tick_;
  std::array<std::int64_t, assets::kTissueCount> steps_{};
  int changed_first_ = 1 << 30, changed_last_ = -1;
};

}  // namespace

CarveResult& CarveResult::operator+=(const CarveResult& part) noexcept {
  removed_mm3 += part.removed_mm3;
  for (std::size_t label = 0; label < removed_mm3_by_label.size(); ++label)
    removed_mm3_by_label[label] += part.removed_mm3_by_label[label];
  return *this;
}

CarveResult carveSphere(CarvedBone& bone, const calibration::Point<calibration::Patient>& centre_P, double radius_mm,
                        const ErosionParameters& erosion, double dt_s, std::uint64_t tick) noexcept {
  const BallRows ball(bone.grid(), centre_P, radius_mm);
  if (ball.empty()) return {};
  const auto loss = fullLoss(erosion, dt_s);
  Cutter cutter(bone, ball, loss, tick);

  // Brick row by brick row, so that a brick is handed over once and not once a voxel.
  constexpr int kEdge = assets::kBrickVoxels;
  static_assert(kEdge <= kRowsAtOnce);
  std::array<BallRow, kRowsAtOnce> row;
  for (int brick_k = ball.first.z / kEdge; brick_k <= ball.last.z / kEdge; ++brick_k)
    for (int brick_j = ball.first.y / kEdge; brick_j <= ball.last.y / kEdge; ++brick_j) {
      const glm::ivec2 from = glm::max(glm::ivec2(ball.first.y, ball.first.z), kEdge * glm::ivec2(brick_j, brick_k));
      const glm::ivec2 to =
          glm::min(glm::ivec2(ball.last.y, ball.last.z), kEdge * glm::ivec2(brick_j, brick_k) + (kEdge - 1));
      for (int k = from.y; k <= to.y; ++k) {
        ball.rows(from.x, k, row);
        for (int j = from.x; j <= to.x; ++j) cutter.cutRow(row[static_cast<std::size_t>(j - from.x)], j, k);
      }
      cutter.markBricks(brick_j, brick_k);
    }
  return cutter.result();
}

CarveResult carveSweep(CarvedBone& bone, const calibration::Point<calibration::Patient>& from_P,
                       const calibration::Point<calibration::Patient>& to_P, double radius_mm,
                       const ErosionParameters& erosion, double dt_s, std::uint64_t tick) noexcept {
  const double length_mm = glm::length(to_P.mm - from_P.mm);
  if (!std::isfinite(length_mm)) return {};
  const double wanted = 1.0 + std::ceil(length_mm / (0.5 * bone.grid().spacing_mm));
  const int steps = static_cast<int>(std::clamp(wanted, 1.0, static_cast<double>(kMostSweepSteps)));
  CarveResult total;
  for (int step = 0; step < steps; ++step) {
    const double along = steps == 1 ? 1.0 : static_cast<double>(step) / (steps - 1);  // both ends are reached
    const calibration::Point<calibration::Patient> centre_P{glm::mix(from_P.mm, to_P.mm, along)};
    total += carveSphere(bone, centre_P, radius_mm, erosion, dt_s / steps,
                         tick * kMostSweepSteps + static_cast<std::uint64_t>(step));
  }
  return total;
}

}  // namespace haptics
