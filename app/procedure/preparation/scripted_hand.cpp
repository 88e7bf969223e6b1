#include "app/procedure/preparation/scripted_hand.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/gtc/quaternion.hpp>

namespace app {

void ScriptedHand::take(const haptics::Tool& tool, const std::string& name) {
  constexpr double kChange_s = 0.8;
  tool_ = tool;
  if (script_.poses.empty()) return;
  stay(kChange_s, false);
  script_.requests.push_back({t_s_, name, "", "scripted hand"});
  stay(kChange_s, false);
}

void ScriptedHand::go(const glm::dvec3& end_mm, const glm::dvec3& shaft, double mm_per_s, bool works) {
  const haptics::BurShape& bur = tool_.head;
  const bool is_bur = tool_.turns();
  const double half_mm =
      is_bur ? 0.5 * bur.length_mm + (bur.kind == haptics::ShapeKind::capsule ? bur.radius_mm : 0.0) : 0.0;
  const glm::dvec3 middle_P = frame_.inP(end_mm + half_mm * shaft);
  const glm::dquat rotation(kUp, frame_.axes_P * shaft);
  if (!script_.poses.empty()) {
    constexpr double kLeast_s = 0.002;
    t_s_ += std::max(kLeast_s, glm::distance(end_mm, at_mm_) / mm_per_s);
    script_.poses.back().pedal = works;
  }
  script_.poses.push_back({t_s_, {glm::normalize(rotation), middle_P}, works, 0u});
  at_mm_ = end_mm;
}

void ScriptedHand::stay(double seconds, bool works) {
  if (script_.poses.empty()) return;
  t_s_ += seconds;
  script_.poses.back().pedal = works;
  haptics::TimedHandlePose same = script_.poses.back();
  same.t_s = t_s_;
  script_.poses.push_back(same);
}

double lowestEnd_mm(const OcclusalMap& map, const glm::dvec2& at_mm, const haptics::BurShape& bur, double stock_mm) {
  constexpr int kRings = 5, kSpokes = 16;
  // A wall in the map leans by one of its steps.
  const double radius_mm = bur.radius_mm + stock_mm - 0.5 * OcclusalMap::kStep_mm;
  double end_mm = map.at(at_mm);
  for (int ring = 1; ring <= kRings; ++ring) {
    const double off_mm = radius_mm * ring / kRings;
    // A round end is higher there than at its middle.
    const double rise_mm = bur.kind == haptics::ShapeKind::capsule
                               ? radius_mm - std::sqrt(std::max(0.0, radius_mm * radius_mm - off_mm * off_mm))
                               : 0.0;
    for (int n = 0; n < kSpokes; ++n) {
      const double turn = 2.0 * std::numbers::pi * n / kSpokes;
      end_mm = std::max(end_mm, map.at(at_mm + off_mm * glm::dvec2(std::cos(turn), std::sin(turn))) - rise_mm);
    }
  }
  return end_mm + stock_mm;
}

}  // namespace app
