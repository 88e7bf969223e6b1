#include "app/device/file_script.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/core.h>

#include "app/case/fitting_cone.h"
#include "app/device/access_script.h"

namespace app {
namespace {

constexpr int kSizes[] = {10, 15, 20, 25};
constexpr double kAbove_mm = 9.0;  ///< the tip over the orifice, out of the crown, between two files
constexpr double kIn_mm_per_s = 4.0, kOut_mm_per_s = 12.0, kStroke_mm_per_s = 8.0;
constexpr double kDrill_mm_per_s = 8.0;
constexpr double kStroke_mm = 1.5;
constexpr int kStrokes = 6;
constexpr double kLeadsBy_mm = 0.3;  ///< the hand ahead of the file at length: what presses it in
constexpr double kOver_s = 1.0;      ///< to the next orifice
constexpr double kChange_s = 0.8;    ///< for another file
constexpr double kTurn_rad = 0.6, kTurns_Hz = 1.5;
constexpr double kStep_s = 0.02;
constexpr double kConeHeld_mm = 21.0, kConeLeadsBy_mm = 0.1, kLays_s = 1.0, kPress_mm_per_s = 1.0;
constexpr double kPresses_mm[] = {1.2, 2.0, 2.6};  ///< below the orifice

/// +z of the tool away from the tip.
glm::dquat heldAlong(const glm::dvec3& in) {
  const glm::dvec3 z = -in, helper = std::fabs(z.x) < 0.9 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
  const glm::dvec3 x = glm::normalize(glm::cross(helper, z));
  return glm::normalize(glm::quat_cast(glm::dmat3(x, glm::cross(z, x), z)));
}

class Hand {
 public:
  explicit Hand(HandScript& script) : script_(script) {}

  /// Along the tooth: so the handle clears the crown, and the file bends into its canal.
  void take(const assets::ToothCanal& canal, const assets::ToothFrame& tooth, double length_mm) {
    if (!script_.poses.empty()) t_s_ += kOver_s;
    in_ = -tooth.axes_P[2];
    rotation_ = heldAlong(in_);
    orifice_P_mm_ = canal.orifice_P_mm();
    length_mm_ = length_mm;
    deep_mm_ = -kAbove_mm;
    put();
  }
  void wait(double s) {
    t_s_ += s;
    put();
  }
  /// Along the tooth, the bur's middle from place to place, turning.
  void drill(const std::vector<glm::dvec3>& way_P, const assets::ToothFrame& tooth) {
    in_ = -tooth.axes_P[2];
    rotation_ = heldAlong(in_);
    script_.requests.push_back({t_s_, kAccessBur, "", "scripted hand"});
    t_s_ += kChange_s;
    for (std::size_t n = 0; n < way_P.size(); ++n) {
      if (n > 0) t_s_ += glm::distance(way_P[n - 1], way_P[n]) / kDrill_mm_per_s + 1e-3;
      script_.poses.push_back({t_s_, {rotation_, way_P[n]}, n + 2 < way_P.size(), 0u});
    }
  }
  void ask(const std::string& tool) { script_.requests.push_back({t_s_, tool, "", "scripted hand"}); }
  void press(bool pedal) { pedal_ = pedal; }
  /// The tip's way beyond the orifice, along the file.
  void move(double to_mm, double mm_per_s, bool turns) {
    const double from_mm = deep_mm_, began_s = t_s_, s = std::fabs(to_mm - from_mm) / mm_per_s;
    const int steps = std::max(1, static_cast<int>(std::ceil(s / kStep_s)));
    for (int n = 1; n <= steps; ++n) {
      const double share = static_cast<double>(n) / steps;
      deep_mm_ = glm::mix(from_mm, to_mm, share);
      t_s_ = began_s + share * s;
      // Fades out towards the end, so that nothing stays wound up.
      turned_rad_ = turns ? kTurn_rad * (1.0 - share * share) * std::sin(2.0 * std::numbers::pi * kTurns_Hz * share * s)
                          : turned_rad_ * (1.0 - share);
      put();
    }
  }

 private:
  void put() {
    const glm::dvec3 handle_P = orifice_P_mm_ + (deep_mm_ - length_mm_) * in_;
    const glm::dquat turned = rotation_ * glm::angleAxis(turned_rad_, glm::dvec3(0.0, 0.0, -1.0));
    if (!script_.poses.empty() && !(t_s_ > script_.poses.back().t_s)) t_s_ = script_.poses.back().t_s + 1e-3;
    script_.poses.push_back({t_s_, {glm::normalize(turned), handle_P}, pedal_, 0u});
  }

  HandScript& script_;
  glm::dvec3 in_{0.0, 0.0, -1.0}, orifice_P_mm_{0.0};
  glm::dquat rotation_{1.0, 0.0, 0.0, 0.0};
  double length_mm_ = 25.0, deep_mm_ = 0.0, turned_rad_ = 0.0, t_s_ = 0.0;
  bool pedal_ = false;
};

/// With the cone that the default tray holds for it.
void fill(Hand& hand, const assets::ToothCanal& canal, const assets::ToothFrame& tooth, double deep_mm) {
  hand.take(canal, tooth, kConeHeld_mm);
  hand.ask(orderOf(fittingCone(canal)));
  hand.wait(kChange_s);
  hand.move(deep_mm + kConeLeadsBy_mm, kIn_mm_per_s, false);
  // Let go of.
  hand.press(true);
  hand.wait(kStep_s);
  hand.wait(kStep_s);
  hand.press(false);
  hand.wait(kLays_s);
  hand.move(-kAbove_mm, kOut_mm_per_s, false);
  hand.take(canal, tooth, 0.0);
  hand.ask("root-plugger");
  hand.wait(kChange_s);
  hand.move(-1.0, kIn_mm_per_s, false);
  hand.press(true);
  for (const double press_mm : kPresses_mm) {
    hand.move(press_mm, kPress_mm_per_s, false);
    hand.move(-0.5, kIn_mm_per_s, false);
  }
  hand.press(false);
  hand.move(-kAbove_mm, kOut_mm_per_s, false);
}

}  // namespace

HandScript fileScript(const assets::ToothCanals& tooth, bool opens, double length_mm) {
  constexpr double kShortOfForamen_mm = 0.5;
  HandScript script;
  Hand hand(script);
  if (opens) hand.drill(accessWay_P(tooth), tooth.frame);
  const assets::ToothCanal* straightest = nullptr;
  for (const assets::ToothCanal& canal : tooth.canals) {
    if (canal.joins) continue;
    const double deep_mm = canal.length_mm() - kShortOfForamen_mm;
    if (straightest == nullptr || canal.schneider_rad < straightest->schneider_rad) straightest = &canal;
    for (const int size : kSizes) {
      hand.take(canal, tooth.frame, length_mm);
      hand.ask(fmt::format("k-file:{},{:g}", size, length_mm));
      hand.wait(kChange_s);
      hand.move(deep_mm + kLeadsBy_mm, kIn_mm_per_s, true);
      for (int stroke = 0; stroke < kStrokes; ++stroke) {
        hand.move(deep_mm - kStroke_mm, kStroke_mm_per_s, false);
        hand.move(deep_mm + kLeadsBy_mm, kStroke_mm_per_s, false);
      }
      hand.move(-kAbove_mm, kOut_mm_per_s, false);
    }
  }
  if (straightest != nullptr) fill(hand, *straightest, tooth.frame, straightest->length_mm() - kShortOfForamen_mm);
  return script;
}

}  // namespace app
