#include "app/procedure/root_canal/canal_outcomes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace app {
namespace {

constexpr double kStep_mm = 0.25;          ///< between sections
constexpr double kOrifice_mm = 1.0;        ///< no section so near to the chamber
constexpr double kOpenEnds_mm = 0.3;       ///< and to the foramen
constexpr int kAxisEnds = 1;               ///< sections more, where a foramen opens aside
constexpr double kThinApex_mm = 2.0;       ///< every root is thin so near to its foramen
constexpr double kBeside_mm = 2.5;         ///< a voxel farther from every axis is not of a canal
constexpr double kWorkingLength_mm = 0.5;  ///< short of the foramen
constexpr double kTaperLength_mm = 5.0;

struct Nearest {
  std::size_t place = 0;
  double squared_mm2 = std::numeric_limits<double>::max();
};

Nearest nearestOf(const assets::ToothCanal& canal, const glm::dvec3& p_P) {
  Nearest nearest;
  for (std::size_t n = 0; n < canal.places.size(); ++n) {
    const glm::dvec3 away = p_P - canal.places[n].p_P_mm;
    if (const double squared = glm::dot(away, away); squared < nearest.squared_mm2) nearest = {n, squared};
  }
  return nearest;
}

glm::dvec3 placeOf(const CanalSection& section, const glm::dvec2& at_mm) {
  return section.centre_P_mm + at_mm.x * section.furcation_P + at_mm.y * section.aside_P;
}

/// Straight on to orifice and foramen.
void extend(std::vector<glm::dvec3>& axis_P) {
  if (axis_P.size() < 2) return;
  const auto beyond = [](const glm::dvec3& end, const glm::dvec3& inner, double mm) {
    return end + mm * glm::normalize(end - inner);
  };
  axis_P.insert(axis_P.begin(), beyond(axis_P[0], axis_P[1], kOrifice_mm));
  axis_P.push_back(beyond(axis_P.back(), axis_P[axis_P.size() - 2], kOpenEnds_mm + kAxisEnds * kStep_mm));
}

double schneiderOf(const std::vector<glm::dvec3>& axis_P) {
  if (axis_P.size() < 4) return 0.0;
  std::vector<assets::CanalPlace> places;
  double along_mm = 0.0;
  for (std::size_t n = 0; n < axis_P.size(); ++n) {
    if (n > 0) along_mm += glm::distance(axis_P[n - 1], axis_P[n]);
    places.push_back({axis_P[n], along_mm});
  }
  return assets::schneider_rad(places);
}

double meanRadius_mm(const CanalSection& section) {
  double area = 0.0;
  for (const double r : section.after_mm) area += r * r;
  return std::sqrt(area / static_cast<double>(CanalSection::kRays));
}

/// The longest and the shortest diameter through the axis.
glm::dvec2 diametersOf(const CanalSection& section) {
  constexpr std::size_t kHalf = CanalSection::kRays / 2;
  glm::dvec2 both(0.0, std::numeric_limits<double>::max());
  for (std::size_t ray = 0; ray < kHalf; ++ray) {
    const double mm = section.after_mm[ray] + section.after_mm[ray + kHalf];
    both = {std::max(both.x, mm), std::min(both.y, mm)};
  }
  return both;
}

}  // namespace

CanalOutcomes canalOutcomes(CanalSections& of, double removed_mm3) {
  const assets::ToothCanal& canal = of.canal();
  const auto section_at = [&](double from_foramen_mm) -> const CanalSection& { return of.at(from_foramen_mm); };
  CanalOutcomes out;
  out.removed_mm3 = removed_mm3;
  for (std::size_t n = 0; n < kSections_mm.size(); ++n) out.sections[n] = section_at(kSections_mm[n]);

  // Down the canal, section by section.
  double wall = 0.0, untouched = 0.0, thin = 0.0, behind = 0.0;
  out.least_wall_mm = std::numeric_limits<double>::infinity();
  const auto steps = static_cast<int>(std::floor((canal.length_mm() - kOrifice_mm - kOpenEnds_mm) / kStep_mm));
  for (int n = steps; n >= 0; --n) {
    const CanalSection& section = section_at(kOpenEnds_mm + n * kStep_mm);
    if (n >= kAxisEnds && std::ranges::all_of(section.before_mm, [](double mm) { return std::isfinite(mm); })) {
      out.axis_before_P_mm.push_back(placeOf(section, centroid_mm(section.before_mm)));
      out.axis_after_P_mm.push_back(placeOf(section, centroid_mm(section.after_mm)));
    }
    for (std::size_t ray = 0; ray < CanalSection::kRays; ++ray) {
      if (!std::isfinite(section.before_mm[ray])) continue;
      wall += section.before_mm[ray];
      if (section.is_untouched[ray]) untouched += section.before_mm[ray];
      if (section.from_foramen_mm < kThinApex_mm || !std::isfinite(section.root_mm[ray])) continue;
      behind += section.after_mm[ray];
      if (section.wall_mm(ray) < kThinWall_mm) thin += section.after_mm[ray];
      if (section.wall_mm(ray) >= out.least_wall_mm) continue;
      out.least_wall_mm = section.wall_mm(ray);
      out.thinnest_P_mm = placeOf(section, section.after_mm[ray] * section.wayOf(ray));
    }
  }
  if (wall > 0.0) out.untouched = untouched / wall;
  if (behind > 0.0) out.thin_share = thin / behind;
  extend(out.axis_before_P_mm);
  extend(out.axis_after_P_mm);
  out.schneider_before_rad = schneiderOf(out.axis_before_P_mm);
  out.schneider_after_rad = schneiderOf(out.axis_after_P_mm);

  // The end: diameters, and the line through those of the last millimetres.
  const glm::dvec2 apical_mm = diametersOf(section_at(kWorkingLength_mm));
  out.apical_long_mm = apical_mm.x;
  out.apical_short_mm = apical_mm.y;
  glm::dvec2 sum(0.0);
  double squares = 0.0, products = 0.0;
  const int count = static_cast<int>(kTaperLength_mm / kStep_mm) + 1;
  for (int n = 0; n < count; ++n) {
    const glm::dvec2 point(n * kStep_mm, 2.0 * meanRadius_mm(section_at(kWorkingLength_mm + n * kStep_mm)));
    sum += point;
    squares += point.x * point.x;
    products += point.x * point.y;
  }
  out.taper = (count * products - sum.x * sum.y) / (count * squares - sum.x * sum.x);

  const CanalSection& foramen = section_at(kOpenEnds_mm);
  for (std::size_t ray = 0; ray < CanalSection::kRays; ++ray)
    if (std::isfinite(foramen.before_mm[ray]))
      out.foramen_moved_mm = std::max(out.foramen_moved_mm, foramen.after_mm[ray] - foramen.before_mm[ray]);
  return out;
}

glm::dvec3 furcationSide_P(const assets::ToothCanals& tooth, std::size_t canal) {
  glm::dvec3 others(0.0);
  double count = 0.0;
  const glm::dvec3 own = tooth.frame.local(tooth.canals[canal].orifice_P_mm());
  // Those of the other root: not beside it from cheek to tongue.
  for (const assets::ToothCanal& other : tooth.canals) {
    const glm::dvec3 to = tooth.frame.local(other.orifice_P_mm()) - own;
    if (std::abs(to.x) <= std::abs(to.y)) continue;
    others += to;
    count += 1.0;
  }
  const bool to_mesial = count > 0.0 && others.x > 0.0;
  return (to_mesial ? 1.0 : -1.0) * tooth.frame.axes_P[0];
}

void removedOfCanals(const ToothBlocks& before, const FineSolid& after, const std::vector<assets::ToothCanal>& canals,
                     std::span<const glm::ivec3> blocks, std::span<double> removed_mm3) {
  const assets::VolumeGrid& grid = before.grid();
  const double half_mm = 0.5 * std::sqrt(3.0) * FineSolid::kEdge * grid.spacing_mm;
  std::vector<std::size_t> near;  // canals that may be nearest to a voxel of the block
  std::vector<double> from_middle_mm(canals.size());
  for (const glm::ivec3& block : blocks) {
    const glm::dvec3 middle_P =
        grid.centre_P_mm(FineSolid::kEdge * block) + 0.5 * (FineSolid::kEdge - 1) * grid.spacing_mm;
    double least_mm = std::numeric_limits<double>::max();
    for (std::size_t n = 0; n < canals.size(); ++n) {
      from_middle_mm[n] = std::sqrt(nearestOf(canals[n], middle_P).squared_mm2);
      least_mm = std::min(least_mm, from_middle_mm[n]);
    }
    if (least_mm > kBeside_mm + half_mm) continue;
    near.clear();
    for (std::size_t n = 0; n < canals.size(); ++n)
      if (from_middle_mm[n] <= least_mm + 2.0 * half_mm) near.push_back(n);
    forRemoved(before, after, block, [&](glm::ivec3 ijk, double solid) {
      const glm::dvec3 p_P = grid.centre_P_mm(ijk);
      std::size_t own = near.front();
      Nearest nearest = nearestOf(canals[own], p_P);
      for (std::size_t n = 1; n < near.size(); ++n)
        if (const Nearest other = nearestOf(canals[near[n]], p_P); other.squared_mm2 < nearest.squared_mm2)
          nearest = other, own = near[n];
      if (nearest.squared_mm2 > kBeside_mm * kBeside_mm) return;
      // What lies before the orifice belongs to the access.
      const assets::CanalPlace &first = canals[own].places[0], &second = canals[own].places[1];
      if (nearest.place == 0 && glm::dot(p_P - first.p_P_mm, second.p_P_mm - first.p_P_mm) < 0.0) return;
      removed_mm3[own] += solid * grid.voxelVolume_mm3();
    });
  }
}

void TipTrack::add(double t_s, double along_mm) {
  const double over_mm = along_mm - length_mm_;
  if (last_s_ && was_over_) error_.over_s += t_s - *last_s_;
  error_.at_rest_mm = over_mm + kWorkingLength_mm;
  error_.deepest_mm = last_s_ ? std::max(error_.deepest_mm, error_.at_rest_mm) : error_.at_rest_mm;
  error_.most_over_mm = std::max(error_.most_over_mm, over_mm);
  was_over_ = over_mm > 0.0;
  last_s_ = t_s;
}

}  // namespace app
