#include "app/procedure/preparation/preparation_script.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/gtc/quaternion.hpp>

#include "app/text/usage_error.h"

namespace app {
namespace {

/// As fast as a high-speed bur takes enamel in layers of this height.
constexpr double kCut_mm_per_s = 2.0, kAir_mm_per_s = 60.0;
constexpr double kLayer_mm = 0.4, kClear_mm = 1.0, kPathStep_mm = 0.2, kToCut_mm = 0.02;

/// The end of the bur at places of the tooth's frame, and how it leans.
class ScriptedBur {
 public:
  ScriptedBur(const assets::ToothFrame& frame, const haptics::BurShape& bur)
      : frame_(frame), half_mm_(0.5 * bur.length_mm) {}

  /// `shaft`: unit, in the tooth's frame.
  void go(const glm::dvec3& end_mm, const glm::dvec3& shaft, double mm_per_s, bool turns) {
    const glm::dvec3 middle_P = frame_.inP(end_mm + half_mm_ * shaft);
    const glm::dquat rotation(glm::dvec3(0.0, 0.0, 1.0), frame_.axes_P * shaft);
    if (!poses_.empty()) {
      constexpr double kLeast_s = 0.002;
      t_s_ += std::max(kLeast_s, glm::distance(end_mm, at_mm_) / mm_per_s);
      poses_.back().pedal = turns;
    }
    poses_.push_back({t_s_, {glm::normalize(rotation), middle_P}, turns, 0u});
    at_mm_ = end_mm;
  }
  const glm::dvec3& at_mm() const { return at_mm_; }
  std::vector<haptics::TimedHandlePose> take() { return std::move(poses_); }

 private:
  assets::ToothFrame frame_;
  double half_mm_, t_s_ = 0.0;
  glm::dvec3 at_mm_{0.0};
  std::vector<haptics::TimedHandlePose> poses_;
};

/// The highest of a map under a flat end.
double highestUnder(const OcclusalMap& map, const glm::dvec2& at_mm, double radius_mm) {
  constexpr int kRings = 4, kSpokes = 16;
  double top_mm = map.at(at_mm);
  for (int ring = 1; ring <= kRings; ++ring)
    for (int n = 0; n < kSpokes; ++n) {
      const double turn = 2.0 * std::numbers::pi * n / kSpokes;
      const glm::dvec2 off = radius_mm * ring / kRings * glm::dvec2(std::cos(turn), std::sin(turn));
      top_mm = std::max(top_mm, map.at(at_mm + off));
    }
  return top_mm;
}

/// Cross-sections from the bite down to the ideal, line by line to and fro.
void cutLayers(ScriptedBur& hand, const PreparationMeasure& measure, double radius_mm) {
  const Crown& crown = measure.crown();
  Crown left = crown;
  left.solid = measure.ideal();
  const OcclusalMap wanted(left), had(crown);
  const glm::dvec3 up(0.0, 0.0, 1.0);
  const double reach_mm = crown.reach_mm + radius_mm, line_mm = 0.25 * radius_mm;
  const double clear_mm = crown.top_mm + kClear_mm;
  const double low_mm = measure.rule().box_side == 0 ? 0.0 : measure.rule().box_height_mm;
  for (double level_mm = crown.top_mm - kLayer_mm; level_mm > low_mm - kLayer_mm; level_mm -= kLayer_mm) {
    bool is_forth = true;
    for (double y = -reach_mm; y <= reach_mm; y += line_mm) {
      for (double along = -reach_mm; along <= reach_mm; along += kPathStep_mm) {
        const glm::dvec2 at(is_forth ? along : -along, y);
        const double floor_mm = std::max(highestUnder(wanted, at, radius_mm), low_mm);
        const double end_mm = std::max(level_mm, floor_mm);
        // Beside the tooth, or nothing to be cut on this layer: through the air above.
        const double top_mm = highestUnder(had, at, radius_mm);
        const bool cuts = top_mm > floor_mm + kToCut_mm && top_mm > level_mm && end_mm < level_mm + kLayer_mm;
        if (!cuts) continue;
        if (glm::distance(glm::dvec2(hand.at_mm()), at) > 2.0 * kPathStep_mm) {
          hand.go({hand.at_mm().x, hand.at_mm().y, clear_mm}, up, kAir_mm_per_s, false);
          hand.go({at, clear_mm}, up, kAir_mm_per_s, false);
        }
        hand.go({at, end_mm}, up, kCut_mm_per_s, true);
      }
      is_forth = !is_forth;
    }
  }
  hand.go({hand.at_mm().x, hand.at_mm().y, clear_mm}, up, kAir_mm_per_s, false);
}

}  // namespace

std::vector<haptics::TimedHandlePose> preparationScript(const PreparationMeasure& measure,
                                                        const haptics::BurShape& bur) {
  if (measure.rule().kind != IdealKind::cavity)
    throw UsageError(
        "--device scripted: no hand knows how to prepare a tooth for a crown, give mouse or poses:FILE.csv");
  if (bur.kind != haptics::ShapeKind::cylinder)
    throw UsageError("--tool: a scripted hand prepares a tooth with a flat-ended cylinder, give cylinder:R,L first");
  ScriptedBur hand(measure.crown().frame, bur);
  hand.go({0.0, 0.0, measure.crown().top_mm + kClear_mm}, {0.0, 0.0, 1.0}, kAir_mm_per_s, false);
  cutLayers(hand, measure, bur.radius_mm);
  return hand.take();
}

}  // namespace app
