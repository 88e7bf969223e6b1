#include "haptics/bone/carve.h"

#include <algorithm>
#include <cmath>

#include "haptics/bone/bur_coverage.h"
#include "haptics/bone/filling.h"
#include "haptics/bone/round_coverage.h"

namespace haptics {
namespace {

using calibration::Patient;
using calibration::Point;

/// bone/round_coverage for a head of any shape (bone/bur_coverage).
class HeadCoverage {
 public:
  HeadCoverage(const BurCoverage& bur, double spacing_mm, const ErosionStep& step)
      : bur_(bur), reach_(kBlockReach + bur.voxel_reach), axis_(step.axis_P.xyz), head_(bur.kernelShape()) {
    even_ = 1.0 - (step.speed_share > 0.0 ? std::min(step.speed_share, 1.0) : 0.0);
    per_arm_ = step.mean_arm_mm > 0.0 ? (1.0 - even_) * spacing_mm / step.mean_arm_mm : 0.0;
  }

  bool of(glm::ivec3 block, BlockCut& cut) {
    const glm::ivec3 corner = block * kBlockEdge;
    const glm::dvec3 first = glm::dvec3(corner) - bur_.centre;
    const double beyond = bur_.beyondFaces(bur_.to_T * (first + 1.5));
    if (beyond >= reach_) return false;
    alignas(64) std::array<float, kBlockVoxels> fraction;
    if (beyond <= -reach_) {
      fraction.fill(1.0f);
    } else if (bur_.hasKernel()) {
      const glm::vec3 place = bur_.positionInTool(corner);
      coverUnderHead(head_, &place.x, fraction.data());
    } else {
      for (int n = 0; n < kBlockVoxels; ++n)
        fraction[static_cast<std::size_t>(n)] =
            static_cast<float>(bur_.shareAt(corner + glm::ivec3(n & 3, n >> 2 & 3, n >> 4)).fraction);
    }
    for (std::size_t n = 0; n < fraction.size(); ++n) {
      const float covered = std::clamp(fraction[n], 0.0f, 1.0f) * 65535.0f;
      cut.coverage[n] = static_cast<std::uint16_t>(covered + 0.5f);
      cut.exposure[n] = cut.coverage[n];
    }
    if (per_arm_ > 0.0) exposeByArm(first, cut);
    return true;
  }

 private:
  /// Exposure grows with the sliding speed of the bur's surface.
  void exposeByArm(const glm::dvec3& first, BlockCut& cut) const {
    for (int n = 0; n < kBlockVoxels; ++n) {
      const glm::dvec3 place = first + glm::dvec3(n & 3, n >> 2 & 3, n >> 4);
      const double uneven = even_ + per_arm_ * glm::length(glm::cross(place, axis_));
      const auto at = static_cast<std::size_t>(n);
      cut.exposure[at] = static_cast<std::uint32_t>(cut.coverage[at] * std::clamp(uneven, 0.0, 1000.0));
    }
  }

  const BurCoverage& bur_;
  double reach_;
  glm::dvec3 axis_;
  double even_ = 1.0, per_arm_ = 0.0;
  HeadShape head_;
};

/// Applies a step block by block to bone or filling; Coverage gives the coverage of a block.
template <class Bone>
class Cutter {
 public:
  Cutter(Bone& bone, const ErosionStep& step, std::uint64_t tick, int interleave, StrokeHistory* strokes)
      : bone_(bone),
        strokes_(strokes),
        interleave_(interleave),
        phase_(static_cast<int>(tick % static_cast<std::uint64_t>(interleave))) {
    cut_.tick = tick;
    for (std::size_t label = 0; label < step.loss.size(); ++label) {
      const double requested = step.loss[label] * interleave;
      // Zero for NaN.
      const double loss = requested > 0.0 ? std::min(requested, 1.0) : 0.0;
      cut_.loss_q32[label] = static_cast<std::uint32_t>(loss * 4294967295.0);
    }
  }

  template <class Coverage>
  void cut(Coverage& shape, const VoxelBox& box) {
    const glm::ivec3 first = box.first / kBlockEdge, last = box.last / kBlockEdge;
    const SolidField field = bone_.field();
    for (int z = first.z; z <= last.z; ++z)
      for (int y = first.y; y <= last.y; ++y) {
        const int ahead = (phase_ + interleave_ - (first.x + y + z) % interleave_) % interleave_;
        const std::size_t row = field.blockAt({0, y, z});
        for (int x = first.x + ahead; x <= last.x; x += interleave_) {
          const std::size_t slot = field.slotOf(row + static_cast<std::size_t>(x));
          if (field.weight[slot] == 0 || !shape.of({x, y, z}, cut_)) continue;
          bone_.cutBlock({x, y, z}, cut_, steps_, strokes_);
        }
      }
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
  Bone& bone_;
  StrokeHistory* strokes_;
  int interleave_, phase_;
  BlockCut cut_;
  std::array<std::int64_t, assets::kTissueCount> steps_{};
};

template <class Bone>
CarveResult cutRound(Bone& bone, const Point<Patient>& centre_P, double radius_mm, const ErosionStep& step,
                     std::uint64_t tick, int interleave, StrokeHistory* strokes) noexcept {
  const double radius = radius_mm / bone.grid().spacing_mm;
  const glm::dvec3 centre = bone.grid().indexFromPoint(centre_P.mm);
  if (!(radius > 0.0) || !std::isfinite(radius) || !std::isfinite(glm::length(centre))) return {};
  RoundCoverage shape(centre, radius, bone.grid().spacing_mm, step);
  const VoxelBox box(bone.grid(), centre - shape.outer(), centre + shape.outer());
  if (box.empty()) return {};
  Cutter<Bone> cutter(bone, step, tick, std::max(interleave, 1), strokes);
  cutter.cut(shape, box);
  return cutter.result();
}

template <class Bone>
CarveResult cutWith(Bone& bone, const BurShape& head, const calibration::Pose<Patient, calibration::Tool>& X_PT,
                    const ErosionStep& step, std::uint64_t tick, int interleave, StrokeHistory* strokes) noexcept {
  if (head.kind == ShapeKind::sphere)
    return cutRound(bone, {X_PT.translation_mm}, head.radius_mm, step, tick, interleave, strokes);
  const BurCoverage bur(bone.grid(), head, X_PT);
  if (bur.box.empty()) return {};
  HeadCoverage shape(bur, bone.grid().spacing_mm, step);
  Cutter<Bone> cutter(bone, step, tick, std::max(interleave, 1), strokes);
  cutter.cut(shape, bur.box);
  return cutter.result();
}

}  // namespace

CarveResult& CarveResult::operator+=(const CarveResult& part) noexcept {
  removed_mm3 += part.removed_mm3;
  for (std::size_t label = 0; label < removed_mm3_by_label.size(); ++label)
    removed_mm3_by_label[label] += part.removed_mm3_by_label[label];
  return *this;
}

int carveInterleave(const CarvedBone& bone, const BurShape& head, const ErosionStep& step) noexcept {
  const double radius =
      0.5 * std::sqrt(surfacePerPi_mm2(head)) / bone.grid().spacing_mm;  // of the ball of this surface
  // What was laid and has not set is gone in a step or two anyway.
  const double max_loss = *std::max_element(step.loss.begin(), step.loss.begin() + assets::kScanTissueCount);
  int interleave = radius > 32.0 ? 8 : radius > 16.0 ? 4 : radius > 8.0 ? 2 : 1;
  while (interleave > 1 && !(max_loss * interleave <= 0.75)) interleave /= 2;
  return interleave;
}

CarveResult carveSphere(CarvedBone& bone, const Point<Patient>& centre_P, double radius_mm, const ErosionStep& step,
                        std::uint64_t tick, int interleave, StrokeHistory* strokes) noexcept {
  return cutRound(bone, centre_P, radius_mm, step, tick, interleave, strokes);
}

CarveResult carveTool(CarvedBone& bone, const BurShape& head, const calibration::Pose<Patient, calibration::Tool>& X_PT,
                      const ErosionStep& step, std::uint64_t tick, int interleave, StrokeHistory* strokes) noexcept {
  return cutWith(bone, head, X_PT, step, tick, interleave, strokes);
}

CarveResult carveTool(Filling& filling, const BurShape& head, const calibration::Pose<Patient, calibration::Tool>& X_PT,
                      const ErosionStep& step, std::uint64_t tick, int interleave, StrokeHistory* strokes) noexcept {
  return cutWith(filling, head, X_PT, step, tick, interleave, strokes);
}

CarveResult carveSweep(CarvedBone& bone, const BurShape& head,
                       const calibration::Pose<Patient, calibration::Tool>& from_X_PT,
                       const calibration::Pose<Patient, calibration::Tool>& to_X_PT, const ErosionStep& step,
                       std::uint64_t tick) noexcept {
  const double length_mm = glm::length(to_X_PT.translation_mm - from_X_PT.translation_mm);
  const double turn = 2.0 * std::acos(std::min(1.0, std::abs(glm::dot(from_X_PT.rotation, to_X_PT.rotation))));
  // The tip moves with the rotation.
  const double way_mm = length_mm + turn * (halfHeight_mm(head) + head.radius_mm);
  if (!std::isfinite(way_mm)) return {};
  const double requested = 1.0 + std::ceil(way_mm / (0.5 * bone.grid().spacing_mm));
  const int steps = static_cast<int>(std::clamp(requested, 1.0, static_cast<double>(kMaxSweepSteps)));
  ErosionStep part = step;
  for (double& loss : part.loss) loss /= steps;
  CarveResult total;
  for (int n = 0; n < steps; ++n) {
    const double along = steps == 1 ? 1.0 : static_cast<double>(n) / (steps - 1);  // includes both ends
    const calibration::Pose<Patient, calibration::Tool> X_PT{
        glm::slerp(from_X_PT.rotation, to_X_PT.rotation, along),
        glm::mix(from_X_PT.translation_mm, to_X_PT.translation_mm, along)};
    total += carveTool(bone, head, X_PT, part, tick * kMaxSweepSteps + static_cast<std::uint64_t>(n));
  }
  return total;
}

}  // namespace haptics
