#include "app/procedure/debris/loose_chips.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "assets/ct_volume.h"

namespace app {
namespace {

constexpr double kChipStep_s = 0.01, kChipMove_mm = 0.1;
constexpr double kHalfCell_mm = 0.3;  ///< for slopes
constexpr double kSoftFace_mm = 0.5;  ///< in which soft tissue begins
constexpr double kLift_mm = 0.02;     ///< off a wall along which it slides

}  // namespace

LooseChips::LooseChips(const haptics::Bodies& bodies, const assets::SoftTissueField& soft_tissue,
                       const glm::dvec3& down_P)
    : bodies_(bodies), soft_tissue_(soft_tissue), down_P_(down_P), solid_(bodies.solidInGridOrder()) {
  at_rest_.fill(true);
}

void LooseChips::add(const haptics::ChipPlan& plan, const haptics::Tick& tick) {
  for (const haptics::Chip& chip : plan.chips) {
    LooseChip loose;
    loose.chip = chip;
    loose.at_P_mm = chip.centroid_mm;
    // Of a piece: where that lies.
    if (chip.bone > 0) {
      if (haptics::Bodies::isAside(tick.X_PQ[chip.bone - 1])) continue;
      loose.at_P_mm = (tick.X_PQ[chip.bone - 1] * calibration::Point<calibration::Piece>{chip.centroid_mm}).mm;
    }
    loose.broke_off_P_mm = loose.at_P_mm;
    loose.radius_mm = std::cbrt(0.75 * chip.volume_mm3 / std::numbers::pi);
    chips_.push_back(loose);
  }
}

void LooseChips::followBone(std::span<const glm::ivec3> bricks, const haptics::Tick& newest) {
  std::vector<glm::ivec3> changed(bricks.begin(), bricks.end());
  for (std::size_t n = 0; n < newest.pieces; ++n) {
    const bool rests = haptics::Bodies::isRest(newest.X_PQ[n]);
    if (std::exchange(at_rest_[n], rests) == rests) continue;
    assets::forVoxels(glm::ivec3(0), bodies_.bones()[1].grid().bricks(),
                      [&](glm::ivec3 own) { changed.push_back(own + bodies_.firstBrick()); });
  }
  if (changed.empty()) return;
  const assets::VolumeGrid& grid = bodies_.grid();
  for (const glm::ivec3& brick : changed) {
    std::array<std::uint8_t, 512> jaw{}, piece{};
    bodies_.jaw().copyBrick(brick, jaw);
    const auto own = bodies_.brickOfPiece(brick);
    for (std::size_t n = 0; own && n < newest.pieces; ++n) {
      if (!at_rest_[n]) continue;
      bodies_.bones()[n + 1].copyBrick(*own, piece);
      for (std::size_t v = 0; v < jaw.size(); ++v) jaw[v] = static_cast<std::uint8_t>(std::min(255, jaw[v] + piece[v]));
    }
    std::size_t n = 0;
    assets::forVoxels(glm::ivec3(0), glm::ivec3(assets::kBrickVoxels), [&](glm::ivec3 at) {
      const glm::ivec3 ijk = assets::kBrickVoxels * brick + at;
      if (grid.contains(ijk)) solid_[grid.index(ijk)] = jaw[n];
      ++n;
    });
  }
  // What held a chip up may be gone, and an undo brings one back.
  for (LooseChip& chip : chips_) {
    chip.rests = false;
    const bool is_back = isBackInBone(chip);
    if (chip.state != LooseChip::State::in_bone && is_back) {
      chip.state = LooseChip::State::in_bone;
      chip.restored_mm3 = newest.restored_total_mm3;
    } else if (chip.state == LooseChip::State::in_bone && !is_back && newest.restored_total_mm3 < chip.restored_mm3) {
      chip.state = LooseChip::State::loose;
      chip.at_P_mm = chip.broke_off_P_mm;
    }
  }
  // What was put back and then cut by a bur is no chip any more.
  std::erase_if(chips_, [&](const LooseChip& chip) {
    return chip.state == LooseChip::State::in_bone && newest.undone_strokes == 0 && !isBackInBone(chip);
  });
}

bool LooseChips::isBackInBone(const LooseChip& chip) const {
  const glm::ivec3 brick = chip.chip.voxel / assets::kBrickVoxels;
  std::array<std::uint8_t, 512> bytes{};
  const std::size_t at = assets::indexIn(glm::ivec3(assets::kBrickVoxels), chip.chip.voxel % assets::kBrickVoxels);
  const auto is_solid = [&](std::size_t bone) {
    bodies_.bones()[bone].copyBrick(brick, bytes);
    return bytes[at] >= assets::kHalfSolid;
  };
  if (chip.chip.bone == 0) return is_solid(0);
  // Its piece may have been parted or joined since.
  for (std::size_t bone = 1; bone < bodies_.bones().size(); ++bone)
    if (is_solid(bone)) return true;
  return false;
}

/// Of bone, tooth or soft tissue, 0..1; beyond the volume nothing falls on.
double LooseChips::densityAt(const glm::dvec3& p_P_mm) const {
  const assets::VolumeGrid& grid = bodies_.grid();
  const glm::dvec3 index = grid.indexFromPoint(p_P_mm);
  const glm::dvec3 last = glm::dvec3(grid.size) - 1.0;
  if (!(index.x >= 0.0 && index.y >= 0.0 && index.z >= 0.0 && index.x < last.x && index.y < last.y && index.z < last.z))
    return 1.0;
  const glm::ivec3 low(index);
  const glm::dvec3 f = index - glm::dvec3(low);
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::ivec3 off = assets::cornerOffset(corner);
    const glm::dvec3 share = glm::mix(1.0 - f, f, glm::dvec3(off));
    sum += share.x * share.y * share.z * solid_[grid.index(low + off)];
  }
  const double soft = soft_tissue_.isEmpty() ? 0.0 : 0.5 - soft_tissue_.at(p_P_mm).distance_mm / kSoftFace_mm;
  return std::max(sum / 255.0, std::clamp(soft, 0.0, 1.0));
}

bool LooseChips::isBare(const glm::dvec3& p_P_mm, double within_mm) const {
  const assets::VolumeGrid& grid = bodies_.grid();
  const glm::ivec3 low(glm::floor(grid.indexFromPoint(p_P_mm - within_mm))),
      high(glm::ceil(grid.indexFromPoint(p_P_mm + within_mm)));
  bool is_bare = true;
  assets::forVoxels(glm::max(low, glm::ivec3(0)), glm::min(high + 1, grid.size), [&](glm::ivec3 ijk) {
    is_bare = is_bare && !(solid_[grid.index(ijk)] >= assets::kHalfSolid &&
                           glm::distance(grid.centre_P_mm(ijk), p_P_mm) <= within_mm);
  });
  return is_bare;
}

/// Down the slope of density, unit; against gravity where that is even.
glm::dvec3 LooseChips::outward(const glm::dvec3& p_P_mm) const {
  glm::dvec3 slope(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 way(0.0);
    way[axis] = kHalfCell_mm;
    slope[axis] = densityAt(p_P_mm - way) - densityAt(p_P_mm + way);
  }
  return glm::length(slope) > 1e-6 ? glm::normalize(slope) : -down_P_;
}

/// One step.
void LooseChips::fall(LooseChip& chip) const {
  for (double left_mm = kChipFall_mm_per_s * kChipStep_s; left_mm > 0.0; left_mm -= kChipMove_mm) {
    const glm::dvec3 below = chip.at_P_mm + (kChipMove_mm + chip.radius_mm) * down_P_;
    if (isFree(below)) {
      chip.at_P_mm += kChipMove_mm * down_P_;
      continue;
    }
    const glm::dvec3 n = outward(below);
    const double along_n = -glm::dot(n, down_P_);
    const glm::dvec3 slide = down_P_ + along_n * n;
    // On ground less steep than its friction, or against a wall that leaves it no way.
    chip.rests = true;
    if (along_n > 0.0 && glm::length(slide) <= kChipFriction * along_n) return;
    const glm::dvec3 next = chip.at_P_mm + kChipMove_mm * glm::normalize(slide) + kLift_mm * n;
    if (glm::length(slide) < 1e-6 || !isFree(next + chip.radius_mm * glm::normalize(slide))) return;
    chip.rests = false;
    chip.at_P_mm = next;
  }
}

void LooseChips::follow(const haptics::Tick& tick, const std::optional<SuctionTip>& tip) {
  step_s_ += tick.dt_s;
  if (step_s_ < kChipStep_s) return;
  step_s_ -= kChipStep_s;
  for (LooseChip& chip : chips_) {
    if (chip.state != LooseChip::State::loose) continue;
    const auto is_free = [this](const glm::dvec3& p) { return isFree(p); };
    const glm::dvec3 before = chip.at_P_mm;
    if (tip && drawTowards(*tip, chip.radius_mm, kChipStep_s, is_free, chip.at_P_mm)) {
      chip.state = LooseChip::State::taken;
      continue;
    }
    if (chip.at_P_mm != before)
      chip.rests = false;
    else if (!chip.rests)
      fall(chip);
  }
}

std::vector<const LooseChip*> LooseChips::left() const {
  std::vector<const LooseChip*> some;
  for (const LooseChip& chip : chips_)
    if (chip.state == LooseChip::State::loose) some.push_back(&chip);
  return some;
}

std::vector<const LooseChip*> LooseChips::taken() const {
  std::vector<const LooseChip*> some;
  for (const LooseChip& chip : chips_)
    if (chip.state == LooseChip::State::taken) some.push_back(&chip);
  return some;
}

}  // namespace app
