#include "app/procedure/preparation/preparation_script.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "app/procedure/preparation/scripted_hand.h"
#include "assets/tissue.h"

namespace app {
namespace {

constexpr const char* kCavityBur = "cylinder:0.4,4";
constexpr const char* kRoughingBur = "cylinder:0.5,6";
/// As wide as a margin of 1 mm, so that beside the wall it stays within the tooth's outline.
constexpr const char* kFinishingBur = "capsule:0.5,6";

/// As fast as a high-speed bur takes enamel in such layers.
constexpr double kCut_mm_per_s = 3.0, kFinish_mm_per_s = 4.0, kWall_mm_per_s = 2.0;
constexpr double kClear_mm = 1.0, kToCut_mm = 0.02;
constexpr double kStock_mm = 0.15;  ///< left by roughing
constexpr double kOffNeighbour_mm = 0.1;
constexpr std::uint8_t kSomeNeighbour = 8;  ///< of 255: what a bur would take of the rim of its voxels counts as cut
constexpr double kBeside_mm = 1.5;          ///< as far beside the tooth a bur may be
constexpr std::size_t kTurns = 2;           ///< around the walls: the second takes what the first left

/// What is had and what is wanted, seen from the bite.
struct Maps {
  explicit Maps(const PreparationMeasure& measure)
      : crown(measure.crown()),
        wanted(idealOf(measure)),
        had(measure.crown()),
        neighbours(neighboursOf(measure)),
        rule(measure.rule()) {}

  /// How low an upright bur may go.
  double lowest_mm(const glm::dvec2& at_mm, const haptics::BurShape& bur, double stock_mm) const {
    return std::max({low_mm() + stock_mm, lowestEnd_mm(wanted, at_mm, bur, stock_mm),
                     lowestEnd_mm(neighbours, at_mm, bur, kOffNeighbour_mm)});
  }

  /// Nothing is cut below.
  double low_mm() const {
    if (rule.kind == IdealKind::crown) return rule.margin_height_mm;
    return rule.kind == IdealKind::free || rule.box_side == 0 ? 0.0 : rule.box_height_mm;
  }
  double clear_mm() const { return crown.top_mm + kClear_mm; }

  const Crown& crown;
  OcclusalMap wanted, had, neighbours;
  const IdealRule& rule;

 private:
  static OcclusalMap idealOf(const PreparationMeasure& measure) {
    Crown left = measure.crown();
    left.solid = measure.ideal();
    return OcclusalMap(left);
  }
  static OcclusalMap neighboursOf(const PreparationMeasure& measure) {
    Crown other = measure.crown();
    other.reach_mm += kBeside_mm;
    for (std::size_t v = 0; v < other.label.bytes().size(); ++v) {
      std::uint8_t& label = other.label.bytes()[v];
      const bool is_neighbour = assets::Tissue{label} == assets::Tissue::other_teeth;
      label = static_cast<std::uint8_t>(is_neighbour ? assets::Tissue::enamel : assets::Tissue::unlabelled);
      std::uint8_t& solid = other.solid.bytes()[v];
      solid = is_neighbour && solid >= kSomeNeighbour ? 255 : 0;
    }
    return OcclusalMap(other);
  }
};

struct Raster {
  double line_mm, step_mm, layer_mm, stock_mm;
};

/// Line by line to and fro wherever something is to be cut, no lower than `level_mm` and the ideal, where that is
/// within a layer over the level.
void mill(ScriptedHand& hand, const Maps& maps, const Raster& raster, double level_mm, double mm_per_s) {
  const haptics::BurShape& bur = hand.bur();
  const double reach_mm = maps.crown.reach_mm + bur.radius_mm;
  bool is_forth = true;
  for (double y = -reach_mm; y <= reach_mm; y += raster.line_mm) {
    for (double along = -reach_mm; along <= reach_mm; along += raster.step_mm) {
      const glm::dvec2 at(is_forth ? along : -along, y);
      const double floor_mm = maps.lowest_mm(at, bur, raster.stock_mm), end_mm = std::max(level_mm, floor_mm);
      // Beside the tooth, or nothing to be cut on this layer: through the air above.
      const double there_mm = lowestEnd_mm(maps.had, at, bur, 0.0);
      if (there_mm <= floor_mm + kToCut_mm || there_mm <= level_mm || end_mm >= level_mm + raster.layer_mm) continue;
      if (glm::distance(glm::dvec2(hand.at_mm()), at) > 2.0 * raster.step_mm) hand.goOver(at, maps.clear_mm());
      hand.go({at, end_mm}, ScriptedHand::kUp, mm_per_s, true);
    }
    is_forth = !is_forth;
  }
}

/// Layers from the bite down to the ideal.
void rough(ScriptedHand& hand, const Maps& maps, const Raster& raster) {
  const double low_mm = maps.low_mm() + raster.stock_mm - raster.layer_mm;
  for (double level_mm = maps.crown.top_mm - raster.layer_mm; level_mm > low_mm; level_mm -= raster.layer_mm)
    mill(hand, maps, raster, level_mm, kCut_mm_per_s);
  hand.lift(maps.clear_mm());
}

/// Once over all that roughing left, at the ideal: one layer as high as the crown.
void finish(ScriptedHand& hand, const Maps& maps, const Raster& raster) {
  mill(hand, maps, raster, maps.low_mm() - kClear_mm, kFinish_mm_per_s);
  hand.lift(maps.clear_mm());
}

/// Around the stump on the margin, leaning as its walls do.
void finishWalls(ScriptedHand& hand, const PreparationMeasure& measure, const Maps& maps) {
  const IdealRule& rule = measure.rule();
  const double radius_mm = hand.bur().radius_mm, from_mm = rule.margin_height_mm + rule.fillet_mm;
  const StumpWalls walls(measure.crown(), measure.ideal(), from_mm, from_mm + 1.0);
  const double lean = std::tan(rule.half_angle_rad);
  const auto around = [&](std::size_t n) {
    const double turn = StumpWalls::turn_rad(n), square = walls.squareness(n, 1);
    const glm::dvec3 out(std::cos(turn), std::sin(turn), 0.0);
    const glm::dvec3 shaft = glm::normalize(ScriptedHand::kUp - lean / square * out);
    // The middle of the round end: its radius over the margin, and off the wall drawn down to it.
    const double middle_mm = rule.margin_height_mm + radius_mm;
    const double wall_mm = walls.radius_mm(n, 1) + (walls.height_mm(1) - middle_mm) * lean / square;
    const glm::dvec3 middle =
        middle_mm * ScriptedHand::kUp + (wall_mm + radius_mm / (square * std::cos(rule.half_angle_rad))) * out;
    return std::pair(middle - radius_mm * shaft, shaft);
  };
  bool is_there = false;
  for (std::size_t n = 0; n <= kTurns * StumpWalls::kAround; ++n) {
    const std::size_t at = n % StumpWalls::kAround;
    if (std::isnan(walls.radius_mm(at, 1))) continue;
    const auto [end_mm, shaft] = around(at);
    if (lowestEnd_mm(maps.neighbours, end_mm, hand.bur(), kOffNeighbour_mm) > end_mm.z) {
      is_there = false;
      continue;
    }
    if (!is_there) hand.goOver({end_mm.x, end_mm.y}, maps.clear_mm(), shaft);
    hand.go(end_mm, shaft, kWall_mm_per_s, true);
    is_there = true;
  }
  hand.lift(maps.clear_mm());
}

}  // namespace

std::vector<std::string> scriptedBurs(const IdealRule* rule) {
  if (rule == nullptr) return {kRoughingBur, kFinishingBur, kCavityBur};
  if (rule->kind == IdealKind::cavity) return {kCavityBur};
  return {kRoughingBur, kFinishingBur};
}

HandScript preparationScript(const PreparationMeasure& measure, std::span<const haptics::Tool> tray) {
  const Maps maps(measure);
  ScriptedHand hand(measure.crown().frame);
  hand.take(tray[0], "");
  hand.go({0.0, 0.0, maps.clear_mm()}, ScriptedHand::kUp, ScriptedHand::kAir_mm_per_s, false);
  if (measure.rule().kind == IdealKind::cavity) {
    if (tray.size() > 1) hand.take(tray[2], kCavityBur);
    rough(hand, maps, {.line_mm = 0.1, .step_mm = 0.1, .layer_mm = 0.4, .stock_mm = 0.0});
    return hand.done();
  }
  rough(hand, maps, {.line_mm = 0.7, .step_mm = 0.2, .layer_mm = 0.8, .stock_mm = kStock_mm});
  hand.take(tray[1], kFinishingBur);
  hand.lift(maps.clear_mm());
  finish(hand, maps, {.line_mm = 0.3, .step_mm = 0.2, .layer_mm = maps.clear_mm() + kClear_mm, .stock_mm = 0.0});
  if (measure.rule().kind == IdealKind::crown) finishWalls(hand, measure, maps);
  return hand.done();
}

}  // namespace app
