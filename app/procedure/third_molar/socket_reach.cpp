#include "app/procedure/third_molar/socket_reach.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "assets/ct_volume.h"

namespace app {
namespace {

constexpr double kBand_mm = 3.0;
constexpr double kNearShank_mm = 12.0, kShank_mm = 42.0, kShankStep_mm = 0.5;    ///< beyond the tip
constexpr double kLattice_mm = 0.45;                                             ///< of places that are tried
constexpr double kSinks_mm = 0.05, kShankSinks_mm = 0.15, kShankClear_mm = 0.1;  ///< tip; shank beside a wall; beyond
constexpr double kTouchesNothing_mm = 0.05;                                      ///< of a line of sight

haptics::DistanceField fieldAround(const assets::VolumeGrid& grid, const std::vector<std::uint8_t>& solid,
                                   const glm::dvec3& middle_P_mm) {
  const glm::ivec3 low =
      glm::max(glm::ivec3(glm::floor(grid.indexFromPoint(middle_P_mm - SocketReach::kSeen_mm))), glm::ivec3(0));
  const glm::ivec3 end =
      glm::min(glm::ivec3(glm::ceil(grid.indexFromPoint(middle_P_mm + SocketReach::kSeen_mm))) + 1, grid.size);
  const assets::VolumeGrid part{glm::max(end - low, glm::ivec3(2)), grid.spacing_mm, grid.centre_P_mm(low)};
  std::vector<std::uint8_t> bytes(part.voxelCount(), 0);
  assets::forVoxels(part, [&](glm::ivec3 ijk, std::size_t v) {
    if (grid.contains(ijk + low)) bytes[v] = solid[grid.index(ijk + low)];
  });
  return {part, bytes, kBand_mm};
}

/// Out of the socket, and leant to all sides.
std::vector<glm::dvec3> shaftsAround(const glm::dvec3& out_P) {
  constexpr int kAround = 8;
  const glm::dvec3 side =
      glm::normalize(glm::cross(out_P, std::abs(out_P.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
  const glm::dvec3 across = glm::cross(out_P, side);
  std::vector<glm::dvec3> shafts{out_P};
  for (const double lean_rad : {0.2, 0.4, 0.6, 0.8})
    for (int n = 0; n < kAround; ++n) {
      const double turn = 2.0 * std::numbers::pi * n / kAround;
      shafts.push_back(std::cos(lean_rad) * out_P +
                       std::sin(lean_rad) * (std::cos(turn) * side + std::sin(turn) * across));
    }
  return shafts;
}

}  // namespace

SocketReach::SocketReach(const assets::VolumeGrid& grid, const std::vector<std::uint8_t>& solid,
                         const glm::dvec3& middle_P_mm, const glm::dvec3& out_P)
    : grid_(grid),
      solid_(solid),
      field_(fieldAround(grid, solid, middle_P_mm)),
      shafts_P_(shaftsAround(glm::normalize(out_P))) {}

TipPlace SocketReach::placeAt(const glm::dvec3& p_P_mm, const glm::dvec3& shaft_P) const {
  const auto sample = field_.at(glm::vec3(field_.grid().indexFromPoint(p_P_mm)));
  const glm::dvec3 slope(sample.gradient);
  const double length = glm::length(slope);
  return {p_P_mm, shaft_P, length > 1e-6 ? slope / length : shaft_P, static_cast<double>(sample.distance_mm)};
}

bool SocketReach::isFree(const glm::dvec3& p_P_mm, const glm::dvec3& shaft_P, double radius_mm, double sunk_mm) const {
  if (field_.at_mm(p_P_mm) < radius_mm - sunk_mm) return false;
  // Along a wall that the tip touches the shank, which is no thicker, runs beside it.
  for (double mm = 1.0; mm < kNearShank_mm; mm += kShankStep_mm)
    if (field_.at_mm(p_P_mm + mm * shaft_P) < radius_mm - std::max(kShankSinks_mm, sunk_mm - 0.2 * mm)) return false;
  return isShankFree(p_P_mm, shaft_P, radius_mm + kShankClear_mm);
}

/// Beyond the field: by the voxels around its axis.
bool SocketReach::isShankFree(const glm::dvec3& p_P_mm, const glm::dvec3& shaft_P, double radius_mm) const {
  const glm::dvec3 side = glm::normalize(
      glm::cross(shaft_P, std::abs(shaft_P.x) < 0.7 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0)));
  const glm::dvec3 across = glm::cross(shaft_P, side);
  for (double mm = kNearShank_mm; mm < kShank_mm; mm += kShankStep_mm)
    for (const glm::dvec3& off : {glm::dvec3(0.0), side, -side, across, -across}) {
      const glm::ivec3 ijk(glm::round(grid_.indexFromPoint(p_P_mm + mm * shaft_P + radius_mm * off)));
      if (grid_.contains(ijk) && solid_[grid_.index(ijk)] >= assets::kHalfSolid) return false;
    }
  return true;
}

bool SocketReach::isOpen(const glm::dvec3& from_P_mm, const glm::dvec3& to_P_mm) const {
  const int steps = 1 + static_cast<int>(glm::distance(from_P_mm, to_P_mm) / field_.grid().spacing_mm);
  for (int n = 0; n <= steps; ++n)
    if (field_.at_mm(glm::mix(from_P_mm, to_P_mm, static_cast<double>(n) / steps)) < kTouchesNothing_mm) return false;
  return true;
}

std::vector<SocketReach::Chosen> SocketReach::fewestFor(const std::vector<glm::dvec3>& goals_P_mm, double radius_mm,
                                                        double reach_mm, double most_wall_mm,
                                                        const IsReached& is_reached) const {
  std::vector<Chosen> candidates;
  const double lattice_mm = std::max(kLattice_mm, 0.2 * reach_mm);
  const int half = static_cast<int>(std::ceil(reach_mm / lattice_mm));
  for (const glm::dvec3& goal : goals_P_mm)
    assets::forVoxels(glm::ivec3(-half), glm::ivec3(half + 1), [&](glm::ivec3 off) {
      const glm::dvec3 p = goal + lattice_mm * glm::dvec3(off);
      const double wall_mm = field_.at_mm(p);
      if (glm::distance(p, goal) > reach_mm || wall_mm < radius_mm - kSinks_mm || wall_mm > radius_mm + most_wall_mm)
        return;
      for (const glm::dvec3& shaft : shafts_P_) {
        const TipPlace place = placeAt(p, shaft);
        std::vector<std::size_t> reached;
        for (std::size_t n = 0; n < goals_P_mm.size(); ++n)
          if (is_reached(place, goals_P_mm[n])) reached.push_back(n);
        if (reached.empty() || !isFree(p, shaft, radius_mm)) continue;
        candidates.push_back({place, std::move(reached)});
        break;
      }
    });
  // The one that reaches most of what is left, again and again.
  std::vector<char> is_done(goals_P_mm.size(), 0);
  std::vector<Chosen> chosen;
  for (;;) {
    const Chosen* best = nullptr;
    std::size_t most = 0;
    for (const Chosen& one : candidates) {
      const auto gained =
          static_cast<std::size_t>(std::ranges::count_if(one.goals, [&](std::size_t n) { return is_done[n] == 0; }));
      if (gained > most) most = gained, best = &one;
    }
    if (best == nullptr) break;
    chosen.push_back({best->place, {}});
    for (const std::size_t n : best->goals)
      if (std::exchange(is_done[n], char{1}) == 0) chosen.back().goals.push_back(n);
  }
  // From one to the nearest next.
  for (std::size_t n = 1; n < chosen.size(); ++n) {
    const auto from = chosen.begin() + static_cast<std::ptrdiff_t>(n);
    std::iter_swap(from, std::ranges::min_element(from, chosen.end(), {}, [&](const Chosen& one) {
                     return glm::distance(one.place.at_P_mm, chosen[n - 1].place.at_P_mm);
                   }));
  }
  return chosen;
}

}  // namespace app
