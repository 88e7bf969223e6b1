// A canal and its root in a plane across the canal's axis, before and after: radii from the axis to the canal's wall
// and on to the root's surface, by direction. Solid = 0.5 is the wall. What transportation, centring, untouched wall
// and least dentine are computed from. Frame P, mm. Pure; any thread; some 0.5 ms a section.
#pragma once

#include <array>
#include <vector>

#include "app/procedure/root_canal/tooth_blocks.h"
#include "assets/tooth_canals.h"

namespace app {

struct CanalSection {
  static constexpr std::size_t kRays = 144;
  using Radii = std::array<double, kRays>;

  double from_foramen_mm = 0.0;
  glm::dvec3 centre_P_mm{0.0};
  glm::dvec3 furcation_P{1.0, 0.0, 0.0}, aside_P{0.0, 1.0, 0.0};  ///< unit, across the axis: ray 0, ray kRays / 4
  Radii before_mm{}, after_mm{}, root_mm{};                       ///< infinity: no wall, no surface within reach
  double read_mm = 0.0;                                           ///< farther out nothing was asked of what it is now
  std::array<bool, kRays> is_untouched{};
  /// What was laid in its plane: kLaidEdge x kLaidEdge cells, towards the furcation first; empty: nothing.
  std::vector<bool> is_laid;
  static constexpr int kLaidEdge = 121;
  static constexpr double kLaidCell_mm = 0.02;

  glm::dvec2 wayOf(std::size_t ray) const;
  glm::dvec3 wayInP(std::size_t ray) const;
  double wall_mm(std::size_t ray) const { return root_mm[ray] - after_mm[ray]; }
};

/// `furcation_P`: towards the other root, or to distal.
CanalSection canalSection(const ToothBlocks& before, const FineSolid& after, const assets::ToothCanal& canal,
                          const glm::dvec3& furcation_P, double from_foramen_mm);

/// The same in two steps: what it was, and what it is, of a section that knows what it was.
CanalSection sectionBefore(const ToothBlocks& before, const assets::ToothCanal& canal, const glm::dvec3& furcation_P,
                           double from_foramen_mm);
void measureAfter(CanalSection& section, const ToothBlocks& before, const FineSolid& after);
/// Into `is_laid`.
void lookAtLaid(CanalSection& section, const FineSolid& laid);

/// (X1 - X2) - (Y1 - Y2) of Gambill 1996 (JOE 22:369), X towards the furcation: positive where it moved there.
double transportation_mm(const CanalSection& section);
/// The smaller of both removals over the larger, 1: centred, or nothing removed.
double centring(const CanalSection& section);
/// Of the canal's area, from its axis.
glm::dvec2 centroid_mm(const CanalSection::Radii& radii_mm);

}  // namespace app
