#include "haptics/servo/elevator.h"

#include <cmath>

namespace haptics {
namespace {

/// The turn about z in a rotation: what is left when the shortest tilt is taken off.
glm::dquat rollOf(const glm::dquat& rotation) {
  const double length = std::sqrt(rotation.w * rotation.w + rotation.z * rotation.z);
  return length < 1e-6 ? glm::dquat(1.0, 0.0, 0.0, 0.0)
                       : glm::dquat(rotation.w / length, 0.0, 0.0, rotation.z / length);
}

}  // namespace

std::optional<Elevator::Near> Elevator::nearest(const Bodies& bodies, const PieceSites& sites,
                                                const ElevatorShape& shape, const ToolPose& X_PT) noexcept {
  std::optional<Near> nearest;
  for (std::size_t n = 0; n < bodies.pieces(); ++n) {
    if (!sites.isReady(bodies, n)) continue;
    const double gap_mm = gapOf_mm(shape, X_PT, *sites.scene(n).piece, bodies.pose(n));
    if (!nearest || gap_mm < nearest->gap_mm) nearest = Near{n, gap_mm};
  }
  return nearest;
}

bool Elevator::approach(const Bodies& bodies, const PieceSites& sites, ElevatorKind kind, const ToolPose& blade_X_PT,
                        LedTool& led) noexcept {
  const auto near = nearest(bodies, sites, elevatorShape(kind), blade_X_PT);
  if (!near || near->gap_mm > ElevatorReach::kNear_mm || !hold_.take(kind, blade_X_PT)) return false;
  kind_ = kind;
  slack_ = glm::dquat(1.0, 0.0, 0.0, 0.0);
  keeps_roll_ = false;
  led.leads = true;
  led.holds = false;
  led.piece = near->piece;
  return true;
}

std::optional<std::size_t> Elevator::reach(const Bodies& bodies, const PieceSites& sites, LedTool& led) const noexcept {
  if (led.holds) return {};
  const auto near = nearest(bodies, sites, hold_.shape(), hold_.state().X_PT);
  if (!near) return {};
  led.piece = near->piece;
  if (near->gap_mm > ElevatorReach::kReach_mm) return {};
  led.holds = true;
  return led.piece;
}

/// Where the hand has the tool, less the roll that it turned back.
ToolPose Elevator::wanted(const ToolPose& hand_X_PT, bool keeps_roll) noexcept {
  if (keeps_roll && !keeps_roll_) kept_ = hand_X_PT.rotation * slack_;
  if (keeps_roll) slack_ = rollOf(glm::conjugate(hand_X_PT.rotation) * kept_);
  keeps_roll_ = keeps_roll;
  return {glm::normalize(hand_X_PT.rotation * slack_), hand_X_PT.translation_mm};
}

void Elevator::move(Bodies& bodies, PieceSites& sites, ElevatorKind in_hand, const ToolPose& hand_X_PT, bool keeps_roll,
                    double dt_s, LedTool& led) noexcept {
  // A piece that the blade has left is left alone.
  const double gap_mm =
      led.holds || sites.isReady(bodies, led.piece)
          ? gapOf_mm(hold_.shape(), hold_.state().X_PT, *sites.scene(led.piece).piece, bodies.pose(led.piece))
          : ElevatorReach::kFar_mm;
  const bool is_in_hand = in_hand == kind_;
  if (led.holds && (!is_in_hand || gap_mm > ElevatorReach::kOff_mm)) {
    led.holds = false;
    led.set_aside = sites.letGo(bodies, led.piece);
  }
  if (!is_in_hand || (!led.holds && gap_mm >= ElevatorReach::kFar_mm)) {
    led.leads = false;
    return;
  }

  ElevatorHand hand;
  hand.X_PT = wanted(hand_X_PT, keeps_roll);
  const ElevatorTick tick = led.holds ? sites.lever(bodies, led.piece, hold_, hand, dt_s)
                                      : hold_.step(hand, sites.scene(led.piece), nullptr, dt_s);
  led.unsettled = tick.unsettled;
  if (led.holds) led.torn_share = tick.torn_share;
  led.X_PT = tick.X_PT;
  led.felt = (1.0 / LedTool::kForceScale) * tick.on_hand;
  const double stretch_mm = glm::length(tick.on_hand.force_N.xyz) / hand.stiffness_N_per_mm;
  led.max_stored_Nmm = 0.5 * glm::length(led.felt.force_N.xyz) * stretch_mm;
  led.lever = {static_cast<std::uint8_t>(led.holds ? led.piece + 1 : 0),
               tick.twist_Nmm,
               tick.blade_on_bone_N,
               tick.blade_on_teeth_N,
               tick.blade_on_piece_N,
               tick.wedging.force_N,
               tick.fulcrum_P_mm};
}

}  // namespace haptics
