#include "app/procedure/third_molar/site_solid.h"

#include <algorithm>
#include <cmath>

#include "app/case/gutter_strokes.h"
#include "app/case/operated_crown.h"
#include "app/case/trough_plan.h"

namespace app {
namespace {

constexpr double kClear_mm = 1.0;   ///< of the bur from what it passes over
constexpr double kReach_mm = 22.0;  ///< of the solid that is looked at
constexpr double kOffNeighbour_mm = 0.9;
constexpr double kToCheek[] = {0.0, 0.3, 0.6, 1.0, 1.6}, kToFront[] = {-0.2, 0.0, 0.2, 0.4, 0.6, 0.9};

/// The highest that a ball rests on the straight way between two places.
double highestBetween_mm(const HeightMap& bone, const glm::dvec3& a, const glm::dvec3& b) {
  const int steps = 1 + static_cast<int>(std::ceil(glm::distance(a, b) / HeightMap::kColumn_mm));
  double highest_mm = kNoHeight_mm;
  for (int n = 0; n <= steps; ++n) {
    const glm::dvec3 q = glm::mix(a, b, static_cast<double>(n) / steps);
    HeightMap::near(q, 2.0 * HeightMap::kColumn_mm,
                    [&](int i, int j, double) { highest_mm = std::max(highest_mm, bone.at(i, j)); });
  }
  return highest_mm;
}

/// It cuts along its whole head.
constexpr StrokePlan kLongBur{1.0, 2};

}  // namespace

SiteSolid::SiteSolid(const assets::Patient& now, std::span<const glm::dvec3> tongue_P_mm)
    : now_(now), tongue_P_mm_(tongue_P_mm) {
  const assets::CtVolume& ct = now.ct;
  const int fdi = now.site->fdi;
  const auto crown = operatedCrown(ct, *now.site);
  if (!crown) return;

  const glm::ivec3 low(glm::floor(ct.grid.indexFromPoint(crown->middle_P_mm - kReach_mm)));
  const glm::ivec3 high(glm::ceil(ct.grid.indexFromPoint(crown->middle_P_mm + kReach_mm)));
  const auto is_solid = [&](std::size_t v) { return ct.solid[v] >= assets::kHalfSolid; };
  const std::size_t row = static_cast<std::size_t>(ct.grid.size.x),
                    slice = row * static_cast<std::size_t>(ct.grid.size.y);
  assets::forVoxels(glm::max(low, glm::ivec3(1)), glm::min(high, ct.grid.size - 1), [&](glm::ivec3 ijk) {
    const std::size_t v = ct.grid.index(ijk);
    if (!is_solid(v)) return;
    const bool is_tooth = isOfTooth(ct, v, fdi);
    if (is_tooth) tooth_P_mm_.push_back(ct.grid.centre_P_mm(ijk));
    // Only what is on a surface can be touched first; the tooth's own surface lies partly on bone.
    const auto is_inner = [&](std::size_t beside) {
      return is_solid(beside) && isOfTooth(ct, beside, fdi) == is_tooth;
    };
    if (is_inner(v - 1) && is_inner(v + 1) && is_inner(v - row) && is_inner(v + row) && is_inner(v - slice) &&
        is_inner(v + slice))
      return;
    surface_.push_back({ct.grid.centre_P_mm(ijk), is_tooth, isOtherTooth(ct, v, fdi)});
  });

  const SiteAxes axes = siteAxes(ct, *now.site);
  for (const double to_cheek : kToCheek)
    for (const double to_front : kToFront) ways_.push_back(axes.wayIn(crown->middle_P_mm, to_cheek, to_front));
}

Heights SiteSolid::heightsAlong(const WayIn& way, double bur_radius_mm, double off_tooth_mm, const Margins& margins,
                                double within_mm) const {
  Heights h;
  for (const Point& point : surface_) {
    const glm::dvec3 q = way.local(point.p_P_mm);
    if (std::abs(q.y) > within_mm) continue;
    h.bone.rest(q, bur_radius_mm);
    if (point.is_tooth) h.tooth.rest(q, bur_radius_mm + off_tooth_mm);
    if (point.is_other_tooth) h.lowest.rest(q, bur_radius_mm + kOffNeighbour_mm);
  }
  if (margins.tongue_mm)
    for (const glm::dvec3& p : tongue_P_mm_) {
      const glm::dvec3 q = way.local(p);
      if (std::abs(q.y) <= within_mm) h.lowest.rest(q, bur_radius_mm + *margins.tongue_mm);
    }
  for (const glm::dvec3& p : now_.mandibular_canal_P_mm)
    h.lowest.rest(way.local(p), bur_radius_mm + now_.mandibular_canal_radius_mm + margins.canal_mm);
  return h;
}

assets::PlannedCut cutAlong(const WayIn& way, const Heights& heights, const std::vector<char>& planned,
                            double bur_radius_mm) {
  assets::PlannedCut cut;
  cut.outward_P = way.outward;
  cut.lateral_P = way.across;
  cut.bur_radius_mm = bur_radius_mm;
  cut.strokes_P_mm = gutterStrokes(way, heights, planned, kLongBur);
  if (cut.strokes_P_mm.empty()) return cut;
  cut.surface_P_mm = cut.strokes_P_mm.front().front();

  // From stroke to stroke over whatever stands between.
  glm::ivec2 low(HeightMap::kSide), high(0);
  double top_mm = kNoHeight_mm, over_mm = kNoHeight_mm;
  for (const auto& stroke : cut.strokes_P_mm)
    for (const glm::dvec3& p : stroke) top_mm = std::max(top_mm, way.local(p).z);
  const auto for_columns = [](glm::ivec2 from, glm::ivec2 to, const auto& visit) {
    for (int j = from.y; j <= to.y; ++j)
      for (int i = from.x; i <= to.x; ++i) visit(i, j);
  };
  for_columns(glm::ivec2(0), glm::ivec2(HeightMap::kSide - 1), [&](int i, int j) {
    if (!planned[HeightMap::column(i, j)]) return;
    low = glm::min(low, glm::ivec2(i, j));
    high = glm::max(high, glm::ivec2(i, j));
  });
  for_columns(low, high, [&](int i, int j) { over_mm = std::max(over_mm, heights.bone.at(i, j)); });
  cut.over_mm = std::max(cut.over_mm, over_mm - top_mm + kClear_mm);
  cut.hop_mm.push_back(cut.over_mm);
  for (std::size_t n = 1; n < cut.strokes_P_mm.size(); ++n) {
    const glm::dvec3 from = way.local(cut.strokes_P_mm[n - 1].back()), to = way.local(cut.strokes_P_mm[n].front());
    cut.hop_mm.push_back(std::max(0.0, highestBetween_mm(heights.bone, from, to) + kClear_mm - std::max(from.z, to.z)));
  }
  return cut;
}

}  // namespace app
