// Scenes for tests of elevators: fields of slots and planes, pieces of a single sheet or block, hands. mm.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "haptics/ligament/elevator_hold.h"
#include "tests/haptics/ligament_scene.h"

namespace haptics::phantom {

/// A field whose surface lies where signed distance is 0.
inline DistanceField fieldWhere(glm::ivec3 size, double spacing_mm, const SignedDistance& inside) {
  const ToothPhantom solid = solidOf(size, spacing_mm, inside);
  return {solid.grid, solid.solid, 1.6};
}

/// Blade along z, its tip at a place.
inline ToolPose bladeAt(const glm::dvec3& tip_P_mm, const glm::dquat& turned = {1.0, 0.0, 0.0, 0.0}) {
  return {turned, tip_P_mm};
}

/// About z of T.
inline glm::dquat twisted(double rad) { return glm::angleAxis(rad, glm::dvec3(0.0, 0.0, 1.0)); }
inline double twistOf(const ToolPose& X_PT) { return 2.0 * std::atan2(X_PT.rotation.z, X_PT.rotation.w); }

/// A hand with one pull alone: a force that its bound keeps, no turn.
inline ElevatorHand pushing(const ToolPose& X_PT, const glm::dvec3& force_N) {
  ElevatorHand hand;
  hand.stiffness_N_per_mm = 1.0;
  hand.most_N = glm::length(force_N);
  hand.X_PT = {X_PT.rotation, X_PT.translation_mm + 1e3 * force_N};
  hand.twist_Nmm_per_rad = hand.tilt_Nmm_per_rad = 1e6;
  hand.most_twist_Nmm = hand.most_tilt_Nmm = 1e9;
  return hand;
}

/// A tooth of two roots in its socket, its crown with an inclined face towards the mesial crest, and between both the
/// place of a 34S lying along y. The force goes as in reference/extraction 3.3: half to distal, mostly up.
struct LuxationScene {
  static constexpr double kGap_mm = 1.7;
  glm::dvec3 normal{0.5, 0.0, std::sqrt(0.75)}, across{-std::sqrt(0.75), 0.0, 0.5}, at_mm{-4.6, 0.0, 1.0};
  DistanceField obstacles, crown;
  std::vector<SamplePoint> points;
  ToolPose rest_X_PT;

  explicit LuxationScene(double spacing_mm = 0.5, int crown_rows = 0)
      : obstacles(fieldWhere({100, 60, 140}, 0.2, [this](const glm::dvec3& p) { return bone_mm(p); })),
        crown(fieldWhere({80, 60, 70}, 0.2, [this](const glm::dvec3& p) { return crown_mm(p); })),
        points(twoRoots(spacing_mm)) {
    for (SamplePoint& point : points) {
      point.rest_gap_mm = obstacles.at_mm(point.p_Q_mm);
      point.has_ligament = point.p_Q_mm.z < -0.5;
    }
    for (int i = -4; i < 12; ++i)
      for (int j = -8; j < 8; ++j)
        points.push_back(
            {.p_Q_mm = at_mm + 0.25 * (2.0 * i + 1.0) * across + glm::dvec3(0.0, 0.25 * (2.0 * j + 1.0), 0.0),
             .outward = -normal,
             .area_mm2 = 0.25});
    for (int row = 0; row < crown_rows; ++row)
      addRing(points, {0.0, 0.0, 1.0 + 0.4 * row}, 4.5, 12.0, 0.47, 0.0, 0.0, 0.2);
    for (SamplePoint& point : points) point.has_ligament = point.has_ligament && point.p_Q_mm.z < 0.0;
    const glm::dmat3 axes(across, normal, glm::dvec3(0.0, 1.0, 0.0));
    rest_X_PT = {glm::quat_cast(axes), at_mm + 1.2 * across - 0.5 * kGap_mm * normal - glm::dvec3(0.0, 4.5, 0.0)};
  }

  double bone_mm(const glm::dvec3& p) const {
    const double two = std::min(std::hypot(std::hypot(p.x - 2.6, p.y), p.z + std::clamp(-p.z, 0.0, 11.0)),
                                std::hypot(std::hypot(p.x + 2.6, p.y), p.z + std::clamp(-p.z, 0.0, 11.0)));
    const double roots = two - (2.5 - 1.6 * std::clamp(-p.z, 0.0, 11.0) / 11.0);
    const double crest = std::max(glm::dot(p - at_mm, normal) + kGap_mm, p.x + 4.5);
    return std::min(std::max(p.z + 0.8, 0.22 - roots), std::max(crest, 0.3 - roots));
  }
  double crown_mm(const glm::dvec3& p) const {
    return std::max(-glm::dot(p - at_mm, normal), boxDistance_mm(p - glm::dvec3(0.0, 0.0, 3.3), {7.0, 4.5, 3.0}));
  }

  PieceHold hold(const LigamentLaw& law = {}) const { return {arranged(points), law}; }
  ElevatorScene scene() const { return {&obstacles, nullptr, &crown}; }
  /// The hand turned about the blade's axis towards the tooth.
  ElevatorHand turned(double rad, double most_twist_Nmm) const {
    ElevatorHand hand{.X_PT = rest_X_PT, .most_twist_Nmm = most_twist_Nmm};
    hand.X_PT.rotation = rest_X_PT.rotation * twisted(-rad);
    return hand;
  }
};

}  // namespace haptics::phantom
