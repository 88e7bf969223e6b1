#include "app/procedure/preparation/preparation_outcomes.h"

#include <algorithm>
#include <cmath>

#include "app/text/usage_error.h"

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
    : crown_(std::move(crown)), by_rule_(std::in_place, crown_, rule, option), ideal_(by_rule_->left(crown_)) {
  measureBefore();
}

PreparationMeasure::PreparationMeasure(Crown crown, const assets::PreparedTooth& tooth, const std::string& option)
    : crown_(std::move(crown)), ideal_(crown_.solid) {
  if (tooth.given) {
    takeGiven(*tooth.given, option);
    given_.emplace(crown_, ideal_);
  } else {
    by_rule_.emplace(crown_, idealRule(tooth.ideal, option), option);
    ideal_ = by_rule_->left(crown_);
  }
  measureBefore();
}

void PreparationMeasure::takeGiven(const assets::GivenIdeal& given, const std::string& option) {
  constexpr double kOff = 1e-3, kFar = 1e6;  // voxels
  const assets::VolumeGrid& grid = ideal_.grid();
  const glm::dvec3 off = given.grid.indexFromPoint(grid.origin_P_mm), whole = glm::round(off);
  if (given.grid.spacing_mm != grid.spacing_mm || !(glm::distance(off, whole) < kOff && glm::length(off) < kFar) ||
      given.solid.size() != given.grid.voxelCount())
    throw UsageError(option + ": the ideal is of another tooth");
  // A tooth that was cut before has a smaller box.
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::ivec3 at = ijk + glm::ivec3(whole);
    if (given.grid.contains(at)) ideal_.bytes()[v] = std::min(ideal_.bytes()[v], given.solid[given.grid.index(at)]);
  });
}

void PreparationMeasure::measureBefore() {
  caries_.emplace(crown_);
  // Soft caries is to go, wherever a rule ends; an ideal that was given says so itself.
  if (by_rule_)
    for (std::size_t v = 0; v < ideal_.bytes().size(); ++v)
      if (assets::Tissue{crown_.label.bytes()[v]} == assets::Tissue::caries_soft) ideal_.bytes()[v] = 0;
  distance_.emplace(ideal_);
  if (rule().kind == IdealKind::crown)
    walls_before_.emplace(crown_, crown_.solid, rule().margin_height_mm - kBelowMargin_mm, crown_.top_mm);
}

FillingOutcomes PreparationMeasure::fillingOf(const BoxBytes& made, const LaidBoxes& filling) {
  if (!filling_) filling_.emplace(crown_);
  return filling_->outcomesOf(made, filling);
}

PreparationOutcomes PreparationMeasure::outcomesOf(const BoxBytes& made) const {
  PreparationOutcomes outcomes;
  outcomes.removed = removedMaterial(crown_, made, ideal_, [this](const glm::dvec3& p_mm) { return zone(p_mm); });
  outcomes.deviation = deviationOf(crown_, made, ideal_, *distance_);
  if (caries_->isThere()) outcomes.caries = caries_->outcomeOf(crown_, made);
  if (rule().kind == IdealKind::cavity) outcomes.cavity = cavityForm(crown_, made, rule());
  if (rule().kind != IdealKind::crown) return outcomes;
  const BoxBytes& stump = outcomes.stump.emplace(attached(crown_, made));
  const StumpWalls walls(crown_, stump, rule().margin_height_mm - kBelowMargin_mm, crown_.top_mm);
  const auto heights_mm = marginHeights_mm(*walls_before_, walls);
  outcomes.walls = wallForm(walls, heights_mm);
  outcomes.margin = marginLine(*walls_before_, heights_mm, *outcomes.walls, rule().margin_height_mm);
  // From just under the highest place of the margin, where all is solid still: farther below the uncut tooth bulges.
  double from_mm = -kBelowMargin_mm;
  for (const double height_mm : heights_mm)
    if (!std::isnan(height_mm)) from_mm = std::max(from_mm, height_mm);
  if (from_mm == -kBelowMargin_mm) from_mm = rule().margin_height_mm;
  const CrownColumns columns(crown_, stump, from_mm - walls.step_mm());
  const glm::dvec2 upright(0.0);
  outcomes.axis = InsertionWay{upright, 0.0, columns.undercut_mm3(upright)};
  outcomes.insertion = bestInsertion(columns);
  outcomes.deepest_undercut_mm = deepestUndercut_mm(walls, heights_mm);
  return outcomes;
}

}  // namespace app
