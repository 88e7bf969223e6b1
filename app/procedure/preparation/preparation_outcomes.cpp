#include "app/procedure/preparation/preparation_outcomes.h"

#include <algorithm>
#include <cmath>

namespace app {
namespace {

constexpr double kBelowMargin_mm = 1.0;

/// The most that a wall lies behind what stands over it.
double deepestUndercut_mm(const StumpWalls& walls, const std::array<double, StumpWalls::kAround>& margin_mm) {
  double deepest_mm = 0.0;
  for (std::size_t around = 0; around < StumpWalls::kAround; ++around) {
    if (std::isnan(margin_mm[around])) continue;
    double most_mm = 0.0;
    for (std::size_t level = walls.heights(); level-- > 0 && walls.height_mm(level) > margin_mm[around];) {
      const double r = walls.radius_mm(around, level);
      if (std::isnan(r)) continue;
      deepest_mm = std::max(deepest_mm, (most_mm - r) * walls.squareness(around, level));
      most_mm = std::max(most_mm, r);
    }
  }
  return deepest_mm;
}

}  // namespace

PreparationMeasure::PreparationMeasure(Crown crown, const IdealRule& rule, const std::string& option)
    : crown_(std::move(crown)), rule_(crown_, rule, option), ideal_(rule_.left(crown_)), distance_(ideal_) {
  if (rule.kind == IdealKind::crown)
    walls_before_.emplace(crown_, crown_.solid, rule.margin_height_mm - kBelowMargin_mm, crown_.top_mm);
}

FillingOutcomes PreparationMeasure::fillingOf(const BoxBytes& made, const LaidBoxes& filling) {
  if (!filling_) filling_.emplace(crown_);
  return filling_->outcomesOf(made, filling);
}

PreparationOutcomes PreparationMeasure::outcomesOf(const BoxBytes& made) const {
  PreparationOutcomes outcomes;
  outcomes.removed = removedMaterial(crown_, made, ideal_, rule_);
  outcomes.deviation = deviationOf(crown_, made, ideal_, distance_);
  if (rule().kind == IdealKind::cavity) {
    outcomes.cavity = cavityForm(crown_, made, rule());
    return outcomes;
  }
  const StumpWalls walls(crown_, made, rule().margin_height_mm - kBelowMargin_mm, crown_.top_mm);
  const auto heights_mm = marginHeights_mm(*walls_before_, walls);
  outcomes.walls = wallForm(walls, heights_mm);
  outcomes.margin = marginLine(*walls_before_, heights_mm, *outcomes.walls, rule().margin_height_mm);
  // From just under the highest place of the margin, where all is solid still: farther below the uncut tooth bulges.
  double from_mm = -kBelowMargin_mm;
  for (const double height_mm : heights_mm)
    if (!std::isnan(height_mm)) from_mm = std::max(from_mm, height_mm);
  if (from_mm == -kBelowMargin_mm) from_mm = rule().margin_height_mm;
  const CrownColumns columns(crown_, made, from_mm - walls.step_mm());
  const glm::dvec2 upright(0.0);
  outcomes.axis = InsertionWay{upright, 0.0, columns.undercut_mm3(upright)};
  outcomes.insertion = bestInsertion(columns);
  outcomes.deepest_undercut_mm = deepestUndercut_mm(walls, heights_mm);
  return outcomes;
}

}  // namespace app
