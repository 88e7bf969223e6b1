#include "haptics/bone/lay.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "calibration/random.h"
#include "haptics/bone/laid_voxel.h"
#include "haptics/bone/round_coverage.h"

namespace haptics {
namespace {

constexpr int kWhole = 255, kHalf = 128;
constexpr double kProbe_mm = 0.14;     ///< radius of the places ahead that are looked at
constexpr double kAside_voxels = 3.0;  ///< how far beside a ball material goes in a step

using Weights = std::array<int, kBlockVoxels>;

/// Shares a whole number out by weight: exact in the sum, none more than its weight, another voxel first in every tick.
class Shares {
 public:
  Shares(std::int64_t most, std::int64_t weight, std::uint64_t tick)
      : most_(most),
        weight_(weight),
        rest_(static_cast<std::int64_t>((tick * 0x9E3779B97F4A7C15U >> 33) % static_cast<std::uint64_t>(weight))) {}

  int of(int weight) {
    rest_ += weight * most_;
    const std::int64_t share = rest_ / weight_;
    rest_ -= share * weight_;
    return static_cast<int>(share);
  }

 private:
  std::int64_t most_, weight_, rest_;
};

/// The voxels under a ball, block by block.
class Under {
 public:
  Under(const LaidBall& ball, double radius)
      : ball_(ball),
        field_(ball.filling.field()),
        centre_(ball.filling.grid().indexFromPoint(ball.centre_P.mm)),
        cover_(centre_, radius, ball.filling.grid().spacing_mm, {}) {
    if (std::isfinite(glm::length(centre_)))
      box_ = VoxelBox(ball.filling.grid(), centre_ - cover_.outer(), centre_ + cover_.outer());
  }

  const VoxelBox& box() const { return box_; }
  /// visit(block, its number, coverage 0..255 of each voxel) where `counts(its number)`.
  template <class Counts, class Visit>
  void forBlocks(const VoxelBox& box, const Counts& counts, const Visit& visit) {
    if (box.empty()) return;
    const glm::ivec3 first = box.first / kBlockEdge, last = box.last / kBlockEdge;
    Weights cover;
    assets::forVoxels(first, last + 1, [&](glm::ivec3 block) {
      const std::size_t number = field_.blockAt(block);
      if (counts(number) && coverOf(block, cover)) visit(block, number, cover);
    });
  }
  /// Sums over a block.
  int toothWeight(std::size_t block) const { return ball_.tooth.weight[ball_.tooth.slotOf(block)]; }
  int laidWeight(std::size_t block) const { return field_.weight[field_.slotOf(block)]; }
  bool hasRoom(std::size_t block) const { return toothWeight(block) + laidWeight(block) < kWhole * kBlockVoxels; }
  /// The part of the box on one side of the ball's centre along each axis.
  VoxelBox octant(unsigned number) const {
    VoxelBox part = box_;
    for (int axis = 0; axis < 3; ++axis) {
      const int middle = static_cast<int>(std::floor(centre_[axis])) / kBlockEdge * kBlockEdge;
      if ((number >> axis & 1U) != 0)
        part.first[axis] = std::max(part.first[axis], middle);
      else
        part.last[axis] = std::min(part.last[axis], middle - 1);
    }
    return part;
  }
  bool coverOf(glm::ivec3 block, Weights& cover) {
    if (!cover_.of(block, cut_)) return false;
    for (std::size_t n = 0; n < cover.size(); ++n) cover[n] = (cut_.coverage[n] * kWhole + 32767) / 65535;
    return true;
  }
  const std::uint8_t* tooth(std::size_t block) const {
    return ball_.tooth.solid + ball_.tooth.slotOf(block) * kBlockVoxels;
  }
  const std::uint8_t* laid(std::size_t block) const { return field_.solid + field_.slotOf(block) * kBlockVoxels; }
  const std::uint8_t* label(std::size_t block) const { return field_.label + field_.slotOf(block) * kBlockVoxels; }
  /// Of tooth and filling, in a voxel; 0 outside.
  int solidAt(glm::ivec3 ijk) const {
    if (!field_.grid.contains(ijk)) return 0;
    return ball_.tooth.solidAt(ijk) + field_.solidAt(ijk);
  }
  int laidAt(glm::ivec3 ijk) const { return field_.grid.contains(ijk) ? field_.solidAt(ijk) : 0; }
  bool isInGrid(glm::ivec3 block, std::size_t n) const { return field_.grid.contains(voxelOf(block, n)); }
  static glm::ivec3 voxelOf(glm::ivec3 block, std::size_t n) {
    const int at = static_cast<int>(n);
    return block * kBlockEdge + glm::ivec3(at & 3, at >> 2 & 3, at >> 4);
  }

 private:
  const LaidBall& ball_;
  SolidField field_;
  glm::dvec3 centre_;
  RoundCoverage cover_;
  VoxelBox box_;
  BlockCut cut_;
};

}  // namespace

std::int64_t layBall(const LaidBall& ball, assets::Tissue material, unsigned increment,
                     std::int64_t most_steps) noexcept {
  const double radius = ball.radius_mm / ball.filling.grid().spacing_mm;
  if (most_steps <= 0 || !(radius > 0.0) || !std::isfinite(radius)) return 0;
  Under under(ball, radius);
  bool touches = false;
  const auto lacking = [&](glm::ivec3 block, std::size_t number, const Weights& cover, Weights& lack) {
    const std::uint8_t *const tooth = under.tooth(number), *const laid = under.laid(number);
    std::int64_t sum = 0;
    for (std::size_t n = 0; n < lack.size(); ++n) {
      touches = touches || (cover[n] != 0 && (tooth[n] != 0 || laid[n] != 0));
      const int want = std::max(0, std::min(kWhole - tooth[n], cover[n]) - laid[n]);
      lack[n] = want != 0 && under.isInGrid(block, n) ? want : 0;
      sum += lack[n];
    }
    return sum;
  };
  std::int64_t all = 0;
  Weights lack;
  const auto has_room = [&](std::size_t number) { return under.hasRoom(number); };
  under.forBlocks(under.box(), has_room, [&](glm::ivec3 block, std::size_t number, const Weights& cover) {
    all += lacking(block, number, cover, lack);
  });
  // A face may lie between what is full and what is empty.
  if (all != 0 && !touches)
    under.forBlocks(
        under.box(), [&](std::size_t number) { return !touches && !under.hasRoom(number); },
        [&](glm::ivec3, std::size_t, const Weights& cover) {
          touches = touches || std::any_of(cover.begin(), cover.end(), [](int one) { return one != 0; });
        });
  if (all == 0 || !touches) return 0;
  const std::int64_t due = std::min(all, most_steps);
  Shares shares(due, all, ball.tick);
  std::int64_t done = 0;
  under.forBlocks(under.box(), has_room, [&](glm::ivec3 block, std::size_t number, const Weights& cover) {
    if (lacking(block, number, cover, lack) == 0) return;
    BlockState state = ball.filling.stateOf(number);
    std::int64_t here = 0;
    for (std::size_t n = 0; n < lack.size(); ++n) {
      const int more = shares.of(lack[n]);
      addLaid(state, n, more, static_cast<std::uint8_t>(material), markOf(increment));
      here += more;
    }
    if (here != 0 && ball.filling.setBlock(number, state, ball.strokes)) done += here;
  });
  return done;
}

namespace {

bool canPack(const LaidBall& ball, double share) {
  return !ball.filling.isEmpty() && share > 0.0 && ball.radius_mm > 0.0 && std::isfinite(ball.radius_mm);
}

/// Where what is pressed away may go: air of `part` of the voxels under `wide` that borders on what holds it.
struct Room {
  Under& wide;
  VoxelBox part;
  bool beside_filling = false;  ///< the tooth alone does not hold it
};

std::int64_t pack(const LaidBall& ball, double share, const Room& to) {
  Under under(ball, ball.radius_mm / ball.filling.grid().spacing_mm);
  Under& wide = to.wide;

  // What is in the way, and of which material most of it is.
  std::array<std::int64_t, assets::kTissueCount> of{};
  std::uint16_t mark = 0;
  int thickest = 0;
  const auto excess = [&](std::size_t number, const Weights& cover, Weights& over) {
    const std::uint8_t *const tooth = under.tooth(number), *const laid = under.laid(number),
                              *const label = under.label(number);
    std::int64_t sum = 0;
    for (std::size_t n = 0; n < over.size(); ++n) {
      const int beyond = tooth[n] + laid[n] - (kWhole - cover[n]);
      over[n] = beyond > 0 && isPlastic(label[n]) ? std::min<int>(laid[n], beyond) : 0;
      sum += over[n];
    }
    return sum;
  };
  std::int64_t all = 0;
  Weights weight;
  const auto has_filling = [&](std::size_t number) { return under.laidWeight(number) != 0; };
  under.forBlocks(under.box(), has_filling, [&](glm::ivec3, std::size_t number, const Weights& cover) {
    const std::int64_t here = excess(number, cover, weight);
    if (here == 0) return;
    const BlockState state = ball.filling.stateOf(number);
    for (std::size_t n = 0; n < weight.size(); ++n) {
      of[state.reach[n]] += weight[n];
      if (weight[n] > thickest) thickest = weight[n], mark = state.dose[n];
    }
    all += here;
  });
  if (all == 0) return 0;
  const auto material = static_cast<std::uint8_t>(std::max_element(of.begin(), of.end()) - of.begin());

  // Room beside the ball, where something is to hold on to.
  const auto room = [&](glm::ivec3 block, std::size_t number, const Weights& cover, Weights& free) {
    const std::uint8_t *const tooth = wide.tooth(number), *const laid = wide.laid(number);
    Weights inner;
    if (!under.coverOf(block, inner)) inner.fill(0);
    std::int64_t sum = 0;
    for (std::size_t n = 0; n < free.size(); ++n) {
      free[n] = inner[n] != 0 ? 0 : std::max(0, std::min(kWhole - tooth[n] - laid[n], cover[n]));
      if (free[n] == 0) continue;
      const glm::ivec3 ijk = Under::voxelOf(block, n);
      bool holds = under.isInGrid(block, n) && (to.beside_filling ? 0 : tooth[n]) + laid[n] >= kHalf / 2;
      for (int axis = 0; axis < 3 && !holds && under.isInGrid(block, n); ++axis)
        for (const int way : {-1, 1}) {
          glm::ivec3 next = ijk;
          next[axis] += way;
          holds = holds || (to.beside_filling ? wide.laidAt(next) : wide.solidAt(next)) >= kHalf;
        }
      if (!holds) free[n] = 0;
      sum += free[n];
    }
    return sum;
  };
  std::int64_t free_steps = 0;
  const VoxelBox& part = to.part;
  const auto has_room = [&](std::size_t number) { return wide.hasRoom(number); };
  wide.forBlocks(part, has_room, [&](glm::ivec3 block, std::size_t number, const Weights& cover) {
    free_steps += room(block, number, cover, weight);
  });
  const auto asked = static_cast<std::int64_t>(std::ceil(std::min(share, 1.0) * static_cast<double>(all)));
  const std::int64_t due = std::min({all, free_steps, asked});
  if (due == 0) return 0;

  // Laid first: room is told by the filling as it was. What finds no block stays where it is.
  Shares given(due, free_steps, ball.tick);
  std::int64_t moved = 0, shared = 0;
  wide.forBlocks(part, has_room, [&](glm::ivec3 block, std::size_t number, const Weights& cover) {
    if (shared == due || room(block, number, cover, weight) == 0) return;
    BlockState state = ball.filling.stateOf(number);
    std::int64_t here = 0;
    for (std::size_t n = 0; n < weight.size(); ++n) {
      // What was laid before may have made more room.
      const auto more = static_cast<int>(std::min<std::int64_t>(given.of(weight[n]), due - shared - here));
      addLaid(state, n, more, material, mark);
      here += more;
    }
    shared += here;
    if (here != 0 && ball.filling.setBlock(number, state, ball.strokes)) moved += here;
  });
  if (moved == 0) return 0;
  // As much is taken, from what was in the way before.
  Shares taken(moved, all, ball.tick);
  under.forBlocks(under.box(), has_filling, [&](glm::ivec3, std::size_t number, const Weights& cover) {
    if (excess(number, cover, weight) == 0) return;
    BlockState state = ball.filling.stateOf(number);
    for (std::size_t n = 0; n < weight.size(); ++n) {
      state.solid[n] = static_cast<std::uint8_t>(state.solid[n] - taken.of(weight[n]));
      if (state.solid[n] == 0) state.reach[n] = 0, state.dose[n] = 0;
    }
    ball.filling.setBlock(number, state, ball.strokes);
  });
  return moved;
}

}  // namespace

std::int64_t packBall(const LaidBall& ball, double share) noexcept {
  if (!canPack(ball, share)) return 0;
  Under wide(ball, ball.radius_mm / ball.filling.grid().spacing_mm + kAside_voxels);
  // An eighth of the places around it in every step.
  return pack(ball, share, {wide, wide.octant(static_cast<unsigned>(ball.tick % 8))});
}

std::int64_t packAhead(const LaidBall& ball, const glm::dvec3& ahead, double share) noexcept {
  if (!canPack(ball, share)) return 0;
  // Another place ahead in every step.
  const std::uint64_t bits = calibration::mixedBits(ball.tick);
  const auto share_at = [&](unsigned shift) { return static_cast<double>(bits >> shift & 0xFFFFU) / 65535.0; };
  const glm::dvec3 helper = std::fabs(ahead.x) < 0.7 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
  const glm::dvec3 x = glm::normalize(glm::cross(ahead, helper)), y = glm::cross(ahead, x);
  constexpr double kAside_mm = kHeatedRadius_mm - kProbe_mm;
  LaidBall there = ball;
  there.centre_P.mm += (ball.radius_mm + share_at(0) * kHeated_mm) * ahead +
                       kAside_mm * ((2.0 * share_at(16) - 1.0) * x + (2.0 * share_at(32) - 1.0) * y);
  Under wide(there, kProbe_mm / ball.filling.grid().spacing_mm);
  return pack(ball, share, {wide, wide.box(), true});
}

}  // namespace haptics
