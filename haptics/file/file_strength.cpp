// What a file's metal remembers and bears: bend that stays, turns in a curve, torque, breaking.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "haptics/file/file_in_canal.h"
#include "haptics/file/material_frame.h"

namespace haptics {

using glm::dvec2;
using glm::dvec3;

void FileInCanal::prebend(double bent_mm, double angle_rad, double towards_rad) noexcept {
  const double l = chain_.link_mm;
  std::size_t bent = static_cast<std::size_t>(std::lround(bent_mm / l));
  bent = std::min(bent, chain_.links - 1);
  if (bent == 0) return;
  // About the axis that moves the tip towards that direction.
  const dvec2 towards = turnBy(towards_rad), half = turnBy(0.5 * angle_rad / static_cast<double>(bent));
  for (std::size_t i = chain_.links + 1 - bent; i <= chain_.links; ++i)
    state_.rest_chord[i] = 2.0 * half.y * dvec2(-towards.y, towards.x);
  state_.rest_straight = false;
}

RestTurns FileInCanal::restTurns() const noexcept {
  RestTurns rest;
  rest.straight = state_.rest_straight;
  if (rest.straight) return rest;
  dvec3 side = sideOf(state_.hand_X_PT.rotation);
  for (std::size_t i = 1; i <= chain_.links; ++i) {
    const dvec3& before = state_.shape.direction[i - 1];
    // The material of joint i has turned with the wire.
    const dvec2 roll = turnBy(state_.roll_rad[i] - state_.roll_rad[0]);
    const dvec3 up = glm::cross(before, side), u = roll.x * side + roll.y * up, v = glm::cross(before, u);
    rest.turn[i] = turnOfChord(state_.rest_chord[i].x * u + state_.rest_chord[i].y * v);
    side = carried(side, before, state_.shape.direction[i]);
    side = unitOf(side);
  }
  return rest;
}

void FileInCanal::wearOut(const RestTurns& rest, FileTick& tick) noexcept {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const FileMetal& metal = chain_.metal;
  std::size_t weakest = 0;
  double weakest_Nmm = 0.0;
  dvec3 side = sideOf(state_.hand_X_PT.rotation);
  for (std::size_t i = 1; i <= chain_.links; ++i) {
    const ChainShape& shape = state_.shape;
    const JointBend& bend = balance_.bend[i];
    const double strain = chain_.strain_per_rad[i] * bend.angle_rad;
    if (strain > tick.strain) {
      tick.strain = strain;
      tick.strain_from_tip_mm = whole_mm_ - static_cast<double>(i - 1) * chain_.link_mm;
    }
    if (strain > 0.0) state_.damage[i] += std::fabs(state_.last_roll_rad[i]) / kTurn / turnsToBreak(metal, strain);
    const double torque_Nmm = chain_.twist_Nmm_per_rad[i] * (state_.roll_rad[i - 1] - state_.roll_rad[i]);
    const double share = std::fabs(torque_Nmm) / chain_.breaking_Nmm[i];
    tick.torque_share = std::max(tick.torque_share, share);
    if (weakest == 0 && (share >= 1.0 || state_.damage[i] >= 1.0)) weakest = i, weakest_Nmm = torque_Nmm;

    // Steel bent too far: what is beyond stays.
    const dvec3& from = shape.direction[i - 1];
    if (metal.set_strain > 0.0 && strain > metal.set_strain) {
      const dvec3 before = rest.straight ? from : rest.turn[i] * from;
      const dvec3 about = glm::cross(before, shape.direction[i]);
      const double sine = lengthOf(about), beyond = bend.angle_rad - metal.set_strain / chain_.strain_per_rad[i];
      if (sine > 0.0) {
        const dvec2 roll = turnBy(state_.roll_rad[i] - state_.roll_rad[0]);
        const dvec3 up = glm::cross(from, side), u = roll.x * side + roll.y * up, v = glm::cross(from, u);
        state_.rest_chord[i] += (beyond / sine) * dvec2(glm::dot(about, u), glm::dot(about, v));
        state_.rest_straight = false;
        tick.set = true;
      }
    }
    side = unitOf(carried(side, from, shape.direction[i]));
  }
  if (weakest > 1) {
    breakAt(weakest, weakest_Nmm);
    tick.broken_link = weakest;
  }
}

void FileInCanal::breakAt(std::size_t link, double torque_Nmm) noexcept {
  FileFragment left;
  const double from_base_mm = static_cast<double>(link - 1) * chain_.link_mm;
  left.from_tip_mm = whole_mm_ - from_base_mm;
  left.diameter_mm = 2.0 * chain_.radius_mm[link];
  left.torque_Nmm = torque_Nmm;
  left.damage = state_.damage[link];
  left.links = chain_.links + 1 - link;
  for (std::size_t n = 0; n <= left.links; ++n) left.node_P_mm[n] = state_.shape.node_mm[link - 1 + n];
  fragment_ = left;
  chain_.links = link - 1;
}

}  // namespace haptics
