#include "haptics/servo/tooth_break.h"

#include <algorithm>
#include <cmath>

#include "haptics/body/bridge_strength.h"

namespace haptics {

using calibration::Patient;

void ToothBreak::receive(const Bodies& bodies, const BreakOrder& order) noexcept {
  if (order.serial == serial_) return;
  serial_ = order.serial;
  piece_ = order.piece;
  refused_ = order.plan == nullptr || order.plan->split.blocks.empty() || order.plan->digest != order.plan_digest ||
             order.piece >= bodies.pieces() || bodies.pieces() >= kMaxPieces || order.bodies_digest != bodies.digest();
  if (refused_) return;
  order_[order.piece] = order;
  piece_digest_[order.piece] = bodies.bones()[order.piece + 1].digest();
}

bool ToothBreak::isArmed(const Bodies& bodies, std::size_t piece) const noexcept {
  return order_[piece].plan != nullptr && piece < bodies.pieces() && bodies.pieces() < kMaxPieces &&
         bodies.bones()[piece + 1].digest() == piece_digest_[piece];
}

BreakAnswer ToothBreak::answer(const Bodies& bodies) const noexcept {
  if (serial_ == 0) return BreakAnswer::none;
  if (refused_) return BreakAnswer::refused;
  return isArmed(bodies, piece_) ? BreakAnswer::armed : BreakAnswer::outdated;
}

void ToothBreak::load(std::size_t piece, double share, double force_N, double bending_Nmm) noexcept {
  share_ = std::max(share_, share);
  // A bridge too thick to break holds whatever comes.
  const BreakPlan& plan = *order_[piece].plan;
  if (share < 1.0 || broken_.piece != 0 || plan.bridge.area_mm2 > kMostBreakable_mm2) return;
  broken_ = {static_cast<std::uint8_t>(piece + 1), plan.is_complete, plan.bridge.area_mm2, force_N, bending_Nmm};
}

void ToothBreak::wedge(const Bodies& bodies, std::size_t piece, double wedging_N) noexcept {
  if (!isArmed(bodies, piece)) return;
  const BreakPlan& plan = *order_[piece].plan;
  const BridgeLoad by_blade = wedgedBy(plan.bridge, std::max(0.0, wedging_N));
  load(piece, shareOfBreaking(plan.bridge, plan.enamel_share, by_blade), wedging_N, by_blade.bending_u_Nmm);
}

void ToothBreak::grip(const Bodies& bodies, std::size_t piece, const Wrench<Patient>& on_piece,
                      const calibration::Point<Patient>& at_P) noexcept {
  if (!isArmed(bodies, piece)) return;
  const BreakPlan& plan = *order_[piece].plan;
  const Bridge& bridge = plan.bridge;
  // Into the piece's frame, about the bridge's centre.
  const Bodies::PiecePose& X_PQ = bodies.pose(piece);
  const glm::dquat from_P = glm::conjugate(X_PQ.rotation);
  const glm::dvec3 arm_mm = from_P * (at_P.mm - X_PQ.translation_mm) - bridge.centre_mm;
  const glm::dvec3 force_N = from_P * on_piece.force_N.xyz;
  const glm::dvec3 moment_Nmm = from_P * on_piece.torque_Nmm.xyz + glm::cross(arm_mm, force_N);

  // Away from the other side is a pull.
  const double along_N = glm::dot(force_N, bridge.normal);
  const BridgeLoad by_grip{glm::dot(arm_mm, bridge.normal) > 0.0 ? along_N : -along_N,
                           glm::dot(moment_Nmm, bridge.width_axis), glm::dot(moment_Nmm, bridge.floorwards())};
  const double bending_Nmm =
      std::sqrt(by_grip.bending_u_Nmm * by_grip.bending_u_Nmm + by_grip.bending_v_Nmm * by_grip.bending_v_Nmm);
  load(piece, shareOfBreaking(bridge, plan.enamel_share, by_grip), glm::length(force_N), bending_Nmm);
}

}  // namespace haptics
