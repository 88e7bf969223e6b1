// Bone planned for removal, as the surgeon's hand does it: strokes of a round bur, in the order of the work. What the
// bur sweeps is the plan; scripted hand, layer "plan", flap and measures all read the same strokes. Frame P, mm;
// directions need not be unit. Plain data; any thread. CutField gives distances to it.
#pragma once

#include <cmath>
#include <vector>

#include <glm/glm.hpp>

namespace assets {

struct PlannedCut {
  std::vector<std::vector<glm::dvec3>> strokes_P_mm;  ///< of the bur's centre; none is empty
  std::vector<glm::dvec3> bare_P_mm;                  ///< bur's centres over the crown where no bone covers it
  glm::dvec3 surface_P_mm{0.0};                       ///< a place on the bone in the middle of the cut
  glm::dvec3 outward_P{0.0};                          ///< out of the bone, towards the bur
  glm::dvec3 lateral_P{0.0};                          ///< across the cut, away from the tooth (buccal)
  glm::dvec3 sight_P{0.0};                            ///< to the eye that sees the whole cut, unit; zero: any
  glm::dvec3 shaft_P{0.0};                            ///< from the bur to a handpiece that lies clear, unit; zero: any
  double bur_radius_mm = 1.5;
  double over_mm = 2.0;  ///< above the highest stroke: where the bur goes from one stroke to the next
  /// By stroke: how far above the higher of the two ends that it joins the bur goes from the stroke before, clear of
  /// bone and teeth; empty: over_mm above the highest stroke, always.
  std::vector<double> hop_mm;
};

/// Middle of the box around all strokes.
inline glm::dvec3 middleOf_P_mm(const PlannedCut& cut) {
  glm::dvec3 low(1e9), high(-1e9);
  for (const auto& stroke : cut.strokes_P_mm)
    for (const glm::dvec3& p : stroke) low = glm::min(low, p), high = glm::max(high, p);
  return 0.5 * (low + high);
}

/// A straight slot: the bur goes back and forth along a line on the bone's surface and sinks along its normal. The line
/// is centred at middle_P_mm and runs along outward x lateral.
struct StraightCut {
  glm::dvec3 middle_P_mm{0.0};  ///< of the line, on the bone's surface
  glm::dvec3 outward_P{0.0};
  glm::dvec3 lateral_P{0.0};
  double bur_radius_mm = 2.0;
  double length_mm = 8.0;
  double depth_mm = 4.0;  ///< of the bur's lowest point below the surface
};

/// R/8 deeper each pass, then four passes at full depth while the bone gives way. Sizes that are not positive and
/// directions that are parallel give strokes that are not finite.
inline PlannedCut plannedAlong(const StraightCut& cut) {
  constexpr double kSinksWithin = 0.1;  // of the pass
  constexpr int kFinishingPasses = 4;
  constexpr double kMostPasses = 4096.0;
  const glm::dvec3 outward = glm::normalize(cut.outward_P);
  const glm::dvec3 along = glm::normalize(glm::cross(cut.outward_P, cut.lateral_P));
  const double wanted = std::ceil(cut.depth_mm / (cut.bur_radius_mm / 8.0));
  const int deepening = wanted >= 1.0 ? static_cast<int>(std::fmin(wanted, kMostPasses)) : 1;
  PlannedCut plan;
  plan.surface_P_mm = cut.middle_P_mm;
  plan.outward_P = cut.outward_P;
  plan.lateral_P = cut.lateral_P;
  plan.bur_radius_mm = cut.bur_radius_mm;
  for (int pass = 0; pass < deepening + kFinishingPasses; ++pass) {
    const auto at = [&](double way, int passes) {
      const double height_mm = cut.bur_radius_mm - cut.depth_mm * std::fmin(1.0, passes / double(deepening));
      const double along_mm = (pass % 2 == 0 ? way - 0.5 : 0.5 - way) * cut.length_mm;
      return cut.middle_P_mm + height_mm * outward + along_mm * along;
    };
    plan.strokes_P_mm.push_back({at(0.0, pass), at(kSinksWithin, pass + 1), at(1.0, pass + 1)});
  }
  return plan;
}

}  // namespace assets
