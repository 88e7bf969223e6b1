#include "haptics/body/bridge_break.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "assets/ct_volume.h"
#include "assets/tissue.h"
#include "calibration/geometry/units.h"
#include "calibration/random.h"
#include "haptics/body/bridge_search.h"
#include "haptics/body/piece_split.h"

namespace haptics {
namespace {

/// How far beyond the section a break may run before it is clear of the tooth; tried in turn.
constexpr std::array<double, 3> kMargins_mm{0.5, 1.5, 4.0};
constexpr double kTurn_rad_per_mm = calibration::kPi / 12.0, kMostTurn_rad = calibration::kPi / 4.0;
constexpr double kAnywhere_mm = 1e3;

constexpr std::array<glm::ivec3, 3> kAxes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/// The surface of a break: the plane of the bridge, from the floor of the slot on turned towards -n.
struct Tear {
  glm::dvec3 centre_mm, n, width_axis, floorwards;
  double floor_mm = 0.0;  ///< along `floorwards`, where it begins to turn
  double turn_rad = 0.0;
  double reach_u_mm = 0.0, reach_v_mm = 0.0, floor_reach_mm = 0.0;  ///< from the centre: width, inwards, floorwards

  bool isTurnedAt(const glm::dvec3& p) const {
    return turn_rad > 0.0 && glm::dot(p - centre_mm, floorwards) < floor_mm;
  }
  glm::dvec3 normalAt(const glm::dvec3& p) const {
    return isTurnedAt(p) ? std::cos(turn_rad) * n - std::sin(turn_rad) * floorwards : n;
  }
  /// Above 0 beyond it.
  double distance_mm(const glm::dvec3& p) const {
    return glm::dot(p - (centre_mm + floor_mm * floorwards), normalAt(p));
  }
  bool reaches(const glm::dvec3& p) const {
    const double along_u = glm::dot(p - centre_mm, width_axis), along_v = glm::dot(p - centre_mm, floorwards);
    return std::abs(along_u) <= reach_u_mm && -reach_v_mm <= along_v && along_v <= floor_reach_mm;
  }
};

Tear straightTear(const Bridge& bridge, double margin_mm) {
  return {bridge.centre_mm,
          bridge.normal,
          bridge.width_axis,
          bridge.floorwards(),
          bridge.half_thickness_mm,
          0.0,
          bridge.half_width_mm + margin_mm,
          bridge.half_thickness_mm + margin_mm,
          bridge.half_thickness_mm + margin_mm};
}

/// As far into the crown as there is any. `into_root`: 1 or -1 along the bridge's normal.
Tear turnedTear(const Bridge& bridge, double turn_rad, double into_root, double margin_mm) {
  Tear tear = straightTear(bridge, margin_mm);
  tear.n *= into_root;
  tear.turn_rad = turn_rad;
  tear.reach_u_mm = tear.reach_v_mm = kAnywhere_mm;
  return tear;
}

enum Side : std::int8_t { before = -1, neither = 0, beyond = 1 };

/// The voxels of the piece on either side of a tear.
class Parting {
 public:
  Parting(const Components& components, const Tear& tear)
      : grid_(components.grid()), tear_(tear), part_(grid_.voxelCount(), kAir), is_beyond_(grid_.voxelCount(), 0) {
    assets::forVoxels(grid_, [&](glm::ivec3 ijk, std::size_t v) {
      if (components.pieceAt(ijk) != 0) return;
      part_[v] = kUnseen;
      is_beyond_[v] = tear_.distance_mm(grid_.centre_P_mm(ijk)) > 0.0 ? 1 : 0;
    });
    assets::forVoxels(grid_, [&](glm::ivec3, std::size_t v) {
      if (part_[v] == kUnseen) flood(v);
    });
    decide();
  }

  const Tear& tear() const { return tear_; }
  bool isParted() const {
    return voxels_[0] * grid_.voxelVolume_mm3() >= kLeastPart_mm3 &&
           voxels_[1] * grid_.voxelVolume_mm3() >= kLeastPart_mm3;
  }
  Side sideOf(std::size_t v) const { return part_[v] < 0 ? neither : side_[static_cast<std::size_t>(part_[v])]; }
  double voxelsOn(Side side) const { return voxels_[side == before ? 0 : 1]; }
  /// visit(voxel before, voxel beyond) over the faces along which it parts.
  template <class Visit>
  void forFaces(const Visit& visit) const {
    for (const auto& [a, b] : torn_)
      if (sideOf(a) == before && sideOf(b) == beyond) visit(a, b);
  }

 private:
  static constexpr std::int32_t kAir = -2, kUnseen = -1;
  struct Part {
    double voxels = 0.0;
    bool touches_before = false, touches_beyond = false;
  };

  /// A connected part, without the faces that the tear runs through.
  void flood(std::size_t start) {
    const auto part = static_cast<std::int32_t>(parts_.size());
    parts_.emplace_back();
    part_[start] = part;
    queue_.assign(1, start);
    for (std::size_t head = 0; head < queue_.size(); ++head) {
      const std::size_t v = queue_[head];
      const glm::ivec3 ijk = assets::elementAt(grid_.size, v);
      const bool is_beyond = is_beyond_[v] != 0;
      parts_.back().voxels += 1.0;
      for (const glm::ivec3 axis : kAxes)
        for (const glm::ivec3 next : {ijk + axis, ijk - axis}) {
          if (!grid_.contains(next)) continue;
          const std::size_t other = grid_.index(next);
          if (part_[other] == kAir) continue;
          const bool crosses = is_beyond_[other] != is_beyond_[v];
          if (crosses && tear_.reaches(0.5 * (grid_.centre_P_mm(next) + grid_.centre_P_mm(ijk)))) {
            (is_beyond ? parts_.back().touches_beyond : parts_.back().touches_before) = true;
            if (!is_beyond) torn_.emplace_back(v, other);
          } else if (part_[other] == kUnseen) {
            part_[other] = part;
            queue_.push_back(other);
          }
        }
    }
  }

  /// A part goes to the side on which the tear meets it; a crumb, which holds on there to nothing, stays with what it
  /// was torn from.
  void decide() {
    side_.assign(parts_.size(), neither);
    for (std::size_t n = 0; n < parts_.size(); ++n) {
      const Part& part = parts_[n];
      if (part.voxels * grid_.voxelVolume_mm3() < kLeastPart_mm3) continue;
      // It leads round the tear.
      if (part.touches_before && part.touches_beyond) return;
      side_[n] = part.touches_before ? before : part.touches_beyond ? beyond : neither;
    }
    for (bool changed = true; changed;) {
      changed = false;
      for (const auto& [a, b] : torn_) {
        Side &of_a = side_[static_cast<std::size_t>(part_[a])], &of_b = side_[static_cast<std::size_t>(part_[b])];
        if ((of_a == neither) == (of_b == neither)) continue;
        (of_a == neither ? of_a : of_b) = of_a == neither ? of_b : of_a;
        changed = true;
      }
    }
    for (std::size_t n = 0; n < parts_.size(); ++n)
      if (side_[n] != neither) voxels_[side_[n] == before ? 0 : 1] += parts_[n].voxels;
  }

  assets::VolumeGrid grid_;
  Tear tear_;
  std::vector<std::int32_t> part_;
  std::vector<std::uint8_t> is_beyond_;
  std::vector<Part> parts_;
  std::vector<Side> side_;  ///< by part
  std::vector<std::pair<std::size_t, std::size_t>> torn_;
  std::array<double, 2> voxels_{};
  std::vector<std::size_t> queue_;
};

/// At the least margin that parts the piece; none: it never does.
template <class TearAt>
std::optional<Parting> torn(const Components& components, const TearAt& tear_at) {
  for (const double margin_mm : kMargins_mm)
    if (Parting parting(components, tear_at(margin_mm)); parting.isParted()) return parting;
  return {};
}

bool isEnamel(std::span<const std::uint8_t> label, std::size_t v) {
  return !label.empty() && label[v] == static_cast<std::uint8_t>(assets::Tissue::enamel);
}

/// The side with less enamel in it; of equal ones the larger.
Side rootOf(const Components& components, std::span<const std::uint8_t> label, const Parting& parting) {
  std::array<double, 2> enamel{};
  for (std::size_t v = 0; v < components.grid().voxelCount(); ++v)
    if (isEnamel(label, v) && parting.sideOf(v) != neither) enamel[parting.sideOf(v) == before ? 0 : 1] += 1.0;
  const double share_before = enamel[0] / parting.voxelsOn(before), share_beyond = enamel[1] / parting.voxelsOn(beyond);
  if (share_before != share_beyond) return share_before < share_beyond ? before : beyond;
  return parting.voxelsOn(before) > parting.voxelsOn(beyond) ? before : beyond;
}

double enamelShare(std::span<const std::uint8_t> label, const Parting& parting) {
  double faces = 0.0, of_enamel = 0.0;
  parting.forFaces([&](std::size_t a, std::size_t b) {
    faces += 2.0;
    of_enamel += (isEnamel(label, a) ? 1.0 : 0.0) + (isEnamel(label, b) ? 1.0 : 0.0);
  });
  return faces > 0.0 ? of_enamel / faces : 0.0;
}

/// What comes off: one side, of the voxels at the break the part of their volume on it.
std::vector<std::uint8_t> bytesOff(const Components& components, const Parting& parting, Side off) {
  const assets::VolumeGrid& grid = components.grid();
  std::vector<std::uint8_t> chosen(grid.voxelCount()), at_break(grid.voxelCount());
  for (std::size_t v = 0; v < chosen.size(); ++v) chosen[v] = parting.sideOf(v) == off ? 1 : 0;
  std::vector<std::uint8_t> bytes = bytesOf(components, chosen);

  parting.forFaces([&](std::size_t a, std::size_t b) {
    for (const std::size_t v : {a, b}) {
      const glm::ivec3 ijk = assets::elementAt(grid.size, v);
      assets::forVoxels(glm::max(ijk - 1, glm::ivec3(0)), glm::min(ijk + 2, grid.size),
                        [&](glm::ivec3 beside) { at_break[grid.index(beside)] = 1; });
    }
  });
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (at_break[v] == 0 || components.solidAt(ijk) == 0) return;
    const glm::dvec3 p = grid.centre_P_mm(ijk);
    const double share_before =
        cubeShareBelow(parting.tear().normalAt(p), -parting.tear().distance_mm(p) / grid.spacing_mm);
    if (share_before <= 0.0 || share_before >= 1.0) return;
    const double share = off == before ? share_before : 1.0 - share_before;
    bytes[v] = static_cast<std::uint8_t>(std::lround(components.solidAt(ijk) * share));
  });
  return bytes;
}

std::uint64_t digestOf(const BreakPlan& plan) {
  std::uint64_t digest = plan.is_complete ? 1 : 2;
  const auto mix = [&](std::uint64_t bits) { digest = calibration::mixedBits(digest ^ bits); };
  for (const SplitPlan::Block& block : plan.split.blocks) {
    mix(block.block);
    for (std::size_t n = 0; n < block.given.size(); n += 8) {
      std::uint64_t word = 0;
      for (std::size_t i = 0; i < 8; ++i) word |= static_cast<std::uint64_t>(block.given[n + i]) << (8 * i);
      mix(word);
    }
  }
  mix(std::bit_cast<std::uint64_t>(plan.enamel_share));
  return digest;
}

/// Of a stranger's file, too.
bool isSection(const Bridge& bridge) {
  const auto finite = [](const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  };
  const auto length = [](double mm) { return mm > 0.0 && mm < 100.0; };
  return finite(bridge.centre_mm) && finite(bridge.normal) && finite(bridge.width_axis) &&
         std::abs(glm::length(bridge.normal) - 1.0) < 1e-6 && std::abs(glm::length(bridge.width_axis) - 1.0) < 1e-6 &&
         std::abs(glm::dot(bridge.normal, bridge.width_axis)) < 1e-6 && bridge.area_mm2 > 0.0 &&
         bridge.area_mm2 < 1e4 && length(bridge.width_mm) && length(bridge.thickness_mm) &&
         length(bridge.half_width_mm) && length(bridge.half_thickness_mm);
}

}  // namespace

double cubeShareBelow(const glm::dvec3& n, double distance) {
  // m ascending, their sum 1; alpha: of the cube's corner below, at most 1/2 by symmetry.
  glm::dvec3 m = glm::max(glm::abs(n), glm::dvec3(1e-6));
  const double sum = m.x + m.y + m.z;
  m /= sum;
  std::array<double, 3> sorted{m.x, m.y, m.z};
  std::ranges::sort(sorted);
  const auto [m1, m2, m3] = sorted;
  const double at = std::clamp(0.5 + distance / sum, 0.0, 1.0), alpha = std::min(at, 1.0 - at), m12 = m1 + m2;
  const auto corner = [&](double edge) { return edge * edge * (edge - 3.0 * alpha); };
  double share = 0.0;
  if (alpha < m1)
    share = alpha * alpha * alpha / (6.0 * m1 * m2 * m3);
  else if (alpha < m2)
    share = alpha * (alpha - m1) / (2.0 * m2 * m3) + m1 * m1 / (6.0 * m2 * m3);
  else if (alpha < std::min(m12, m3))
    share = (alpha * alpha * (3.0 * m12 - alpha) + corner(m1) + corner(m2)) / (6.0 * m1 * m2 * m3);
  else if (m3 < m12)
    share = (alpha * alpha * (3.0 - 2.0 * alpha) + corner(m1) + corner(m2) + corner(m3)) / (6.0 * m1 * m2 * m3);
  else
    share = (2.0 * alpha - m12) / (2.0 * m3);
  share = std::clamp(share, 0.0, 0.5);
  return at <= 0.5 ? share : 1.0 - share;
}

std::optional<BreakPlan> breakPlan(const Components& components, std::span<const std::uint8_t> label,
                                   const Bridge& bridge) {
  assert(label.empty() || label.size() == components.grid().voxelCount());
  const auto pieces = components.pieces();
  if (pieces.empty() || (pieces.size() > 1 && pieces[1].volume_mm3 >= kLeastPiece_mm3) || !isSection(bridge)) return {};
  std::optional<Parting> parting = torn(components, [&](double margin_mm) { return straightTear(bridge, margin_mm); });
  if (!parting) return {};

  BreakPlan plan;
  plan.bridge = bridge;
  const double beyond_mm = bridge.area_mm2 / bridge.width_mm - kCleanBreak_mm;
  if (beyond_mm > 0.0) {
    const double turn_rad = std::min(beyond_mm * kTurn_rad_per_mm, kMostTurn_rad);
    const double into_root = rootOf(components, label, *parting) == beyond ? 1.0 : -1.0;
    if (auto turned =
            torn(components, [&](double margin_mm) { return turnedTear(bridge, turn_rad, into_root, margin_mm); })) {
      parting = std::move(turned);
      plan.is_complete = false;
    }
  }
  plan.enamel_share = enamelShare(label, *parting);
  const Side off = parting->voxelsOn(before) < parting->voxelsOn(beyond) ? before : beyond;
  plan.split = splitPlan(components.grid(), bytesOff(components, *parting, off));
  plan.digest = digestOf(plan);
  return plan;
}

}  // namespace haptics
