#include "app/procedure/preparation/filling_script.h"

#include <algorithm>
#include <cmath>

#include "app/procedure/preparation/scripted_hand.h"

namespace app {
namespace {

constexpr double kMostIncrement_mm = 1.2, kOverfill_mm = 0.2;
constexpr double kPlaceStep_mm = 0.2, kLayLine_mm = 0.25, kCarveLine_mm = 0.12;
constexpr double kLay_mm_per_s = 5.0, kCarve_mm_per_s = 4.0;
constexpr double kLight_s = 15.0, kLampOff_mm = 1.0, kOverCrown_mm = 1.5;
constexpr double kCavityDeep_mm = 0.3;  ///< less is the rim
constexpr double kBesideCavity_mm = 0.7;
constexpr int kPasses = 2;

/// The cavity seen from the bite, and where a ball goes over it.
class CavityMaps {
 public:
  explicit CavityMaps(const PreparationMeasure& measure)
      : floor_(measure.crown(), measure.ideal()), intact_(measure.crown()), top_mm_(measure.crown().top_mm) {
    const double reach_mm = measure.crown().reach_mm;
    for (double y = -reach_mm; y <= reach_mm; y += kPlaceStep_mm)
      for (double x = -reach_mm; x <= reach_mm; x += kPlaceStep_mm)
        if (isCut({x, y})) {
          low_ = glm::min(low_, glm::dvec2(x, y)), high_ = glm::max(high_, glm::dvec2(x, y));
          deepest_mm_ = std::min(deepest_mm_, floor_.at({x, y}));
          rim_mm_ = std::max(rim_mm_, intact_.at({x, y}));
        }
  }

  bool isCut(const glm::dvec2& at_mm) const {
    const double was_mm = intact_.at(at_mm);
    return was_mm > 0.0 && was_mm - floor_.at(at_mm) > kCavityDeep_mm;
  }
  /// Of a ball's middle that touches no floor and no wall; over the intact surface.
  double overFloor_mm(const glm::dvec2& at_mm, double radius_mm) const { return overMap_mm(floor_, at_mm, radius_mm); }
  double overIntact_mm(const glm::dvec2& at_mm, double radius_mm) const {
    return overMap_mm(intact_, at_mm, radius_mm);
  }
  double intact_mm(const glm::dvec2& at_mm) const { return intact_.at(at_mm); }
  const glm::dvec2& low_mm() const { return low_; }
  const glm::dvec2& high_mm() const { return high_; }
  double deepest_mm() const { return deepest_mm_; }
  double rim_mm() const { return rim_mm_; }
  double clear_mm() const { return top_mm_ + kOverCrown_mm; }

 private:
  static double overMap_mm(const OcclusalMap& map, const glm::dvec2& at_mm, double radius_mm) {
    return lowestEnd_mm(map, at_mm, {haptics::ShapeKind::capsule, radius_mm, 1.0}, 0.0) + radius_mm;
  }

  OcclusalMap floor_, intact_;
  double top_mm_, deepest_mm_ = 1e3, rim_mm_ = 0.0;
  glm::dvec2 low_{1e3}, high_{-1e3};
};

/// To and fro over the cavity, `beside_mm` around it; `height(place)`: none below 0, not there.
template <class Height>
void sweep(ScriptedHand& hand, const CavityMaps& maps, double line_mm, double beside_mm, double mm_per_s,
           const Height& height) {
  bool is_forth = true;
  for (double y = maps.low_mm().y - beside_mm; y <= maps.high_mm().y + beside_mm; y += line_mm) {
    const double from_mm = maps.low_mm().x - beside_mm, to_mm = maps.high_mm().x + beside_mm;
    for (double along = 0.0; along <= to_mm - from_mm; along += kPlaceStep_mm) {
      const glm::dvec2 at(is_forth ? from_mm + along : to_mm - along, y);
      const double middle_mm = height(at);
      if (middle_mm < 0.0) continue;
      if (glm::distance(glm::dvec2(hand.at_mm()), at) > 3.0 * kPlaceStep_mm) hand.goOver(at, maps.clear_mm());
      hand.go({at, middle_mm}, ScriptedHand::kUp, mm_per_s, true);
    }
    is_forth = !is_forth;
  }
  hand.lift(maps.clear_mm());
}

/// Balls whose lower ends stay below a level: what they lay ends about there.
void layUpTo(ScriptedHand& hand, const CavityMaps& maps, double level_mm, double radius_mm) {
  for (int pass = 0; pass < kPasses; ++pass)
    sweep(hand, maps, kLayLine_mm, 0.0, kLay_mm_per_s, [&](const glm::dvec2& at) {
      if (!maps.isCut(at)) return -1.0;
      const double middle_mm = std::max(level_mm - radius_mm, maps.overFloor_mm(at, radius_mm));
      // Where it finds no room between the walls it would lay outside.
      return middle_mm > std::min(level_mm, maps.intact_mm(at)) + kOverfill_mm ? -1.0 : middle_mm;
    });
}

void cure(ScriptedHand& hand, const CavityMaps& maps, double tip_radius_mm) {
  const glm::dvec2 middle = 0.5 * (maps.low_mm() + maps.high_mm());
  hand.go({middle, maps.rim_mm() + kLampOff_mm + tip_radius_mm}, ScriptedHand::kUp, ScriptedHand::kAir_mm_per_s, false);
  hand.stay(kLight_s, true);
  hand.lift(maps.clear_mm() + tip_radius_mm);
}

}  // namespace

std::vector<std::string> fillingTray() { return {"round:1.0", "composite", "carver", "curing-lamp"}; }

HandScript fillingScript(const PreparationMeasure& measure, std::span<const haptics::Tool> tray) {
  const CavityMaps maps(measure);
  const auto radius_mm = [&](std::size_t n) {
    return haptics::kHandInstrumentSizes[static_cast<std::size_t>(tray[n].hand_instrument)].tip_radius_mm;
  };
  ScriptedHand hand(measure.crown().frame);
  hand.take(tray[0], "");
  hand.go({0.0, 0.0, maps.clear_mm()}, ScriptedHand::kUp, ScriptedHand::kAir_mm_per_s, false);
  const double depth_mm = std::max(0.1, maps.rim_mm() - maps.deepest_mm());
  const int increments = std::max(1, static_cast<int>(std::ceil(depth_mm / kMostIncrement_mm)));
  for (int n = 1; n <= increments; ++n) {
    hand.take(tray[1], "composite");
    const bool is_last = n == increments;
    layUpTo(hand, maps, maps.deepest_mm() + depth_mm * n / increments + (is_last ? kOverfill_mm : 0.0), radius_mm(1));
    if (is_last) {
      hand.take(tray[2], "carver");
      sweep(hand, maps, kCarveLine_mm, kBesideCavity_mm, kCarve_mm_per_s, [&](const glm::dvec2& at) {
        return maps.intact_mm(at) > 0.0 ? maps.overIntact_mm(at, radius_mm(2)) : -1.0;
      });
    }
    hand.take(tray[3], "curing-lamp");
    cure(hand, maps, radius_mm(3));
  }
  return hand.done();
}

}  // namespace app
