#include "app/procedure/third_molar/clearing_plan.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace app {
namespace {

constexpr double kCovers = 0.7;           ///< of the bur's radius: columns that are cut down to a place
constexpr double kOfTheMost = 0.75;       ///< of what the best direction reaches, to be worth a cut
constexpr std::size_t kLeastPlaces = 12;  ///< that are worth a cut

/// What one direction offers.
struct Clearing {
  WayIn way;
  Heights heights;
  std::size_t reached = 0;
  std::vector<char> planned;
  double cut_mm = 0.0;  ///< sum over the columns

  double cost() const { return cut_mm / static_cast<double>(reached); }
};

Clearing clearingAlong(const SiteSolid& site, const WayIn& way, std::span<const glm::dvec3> in_the_way_P_mm,
                       double bur_radius_mm, double off_tooth_mm, const Margins& margins) {
  Clearing one{way, site.heightsAlong(way, bur_radius_mm, off_tooth_mm, margins), 0, {}, 0.0};
  Heights& h = one.heights;
  HeightMap goal;
  for (int j = 0; j < HeightMap::kSide; ++j)
    for (int i = 0; i < HeightMap::kSide; ++i) {
      goal.at(i, j) = -kNoHeight_mm;
      h.lowest.at(i, j) = std::max(h.lowest.at(i, j), h.tooth.at(i, j));
    }
  // As low as the places under a column ask for.
  for (const glm::dvec3& p : in_the_way_P_mm) {
    const glm::dvec3 q = way.local(p);
    bool is_reached = false;
    HeightMap::near(q, kCovers * bur_radius_mm, [&](int i, int j, double square) {
      goal.at(i, j) = std::min(goal.at(i, j), q.z);
      is_reached = is_reached || h.lowest.at(i, j) < q.z + std::sqrt(bur_radius_mm * bur_radius_mm - square);
    });
    one.reached += is_reached ? 1 : 0;
  }
  one.planned.assign(HeightMap::kColumns, 0);
  for (int j = 0; j < HeightMap::kSide; ++j)
    for (int i = 0; i < HeightMap::kSide; ++i) {
      if (goal.at(i, j) == -kNoHeight_mm) continue;
      h.lowest.at(i, j) = std::max(h.lowest.at(i, j), goal.at(i, j));
      if (h.lowest.at(i, j) >= h.bone.at(i, j)) continue;
      one.planned[HeightMap::column(i, j)] = 1;
      one.cut_mm += h.bone.at(i, j) - h.lowest.at(i, j);
    }
  return one;
}

}  // namespace

std::optional<assets::PlannedCut> planClearing(const SiteSolid& site, std::span<const glm::dvec3> in_the_way_P_mm,
                                               double bur_radius_mm, double off_tooth_mm, const Margins& margins) {
  std::vector<Clearing> all;
  std::size_t most = 0;
  for (const WayIn& way : site.waysIn()) {
    all.push_back(clearingAlong(site, way, in_the_way_P_mm, bur_radius_mm, off_tooth_mm, margins));
    most = std::max(most, all.back().reached);
  }
  if (most < kLeastPlaces) return {};
  const Clearing* best = nullptr;
  for (const Clearing& one : all)
    if (static_cast<double>(one.reached) >= kOfTheMost * static_cast<double>(most) &&
        (best == nullptr || one.cost() < best->cost()))
      best = &one;
  assets::PlannedCut cut = cutAlong(best->way, best->heights, best->planned, bur_radius_mm);
  if (cut.strokes_P_mm.empty()) return {};
  return cut;
}

}  // namespace app
