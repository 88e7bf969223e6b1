// An elevator at work for one tick: where blade and piece go together under the hand. One least energy of twelve
// coordinates: hand (hand_coupling), ligament and contact of the piece (piece_hold), blade on obstacles and on the
// piece (blade_contact), friction, drag; then fibres tear as under forceps. The blade touches one piece; another that
// is free is an obstacle, which does not move in that tick. Frames P, T, Q; mm, N, N mm of the model, s. Servo thread:
// no allocation, lock or throw; at most 6 evaluations, 5 µs in the air, 30 to 100 with a piece of 2000 samples. A pure
// function of state and inputs, the same bits on every machine. Method: reference/extraction 5.2, 5.3.
#pragma once

#include "haptics/ligament/blade_contact.h"
#include "haptics/ligament/blade_friction.h"
#include "haptics/ligament/elevator_law.h"
#include "haptics/ligament/elevator_shape.h"
#include "haptics/ligament/hand_coupling.h"
#include "haptics/ligament/piece_hold.h"

namespace haptics {

/// All that an elevator remembers, by value; the piece's own is a PieceState.
struct ElevatorState {
  ToolPose X_PT;  ///< of the blade
  BladeFriction friction;
};

/// What the blade does to two walls of one piece that it lies between: what breaks a bridge of a cut tooth.
struct Wedging {
  double force_N = 0.0;     ///< on each wall, away from the other
  glm::dvec3 axis_P{0.0};   ///< unit, from the one to the other
  glm::dvec3 at_P_mm{0.0};  ///< middle between the pressures of both
};

struct ElevatorTick {
  ToolPose X_PT;                            ///< of the blade
  PiecePose X_PQ;                           ///< of the piece; without one at rest
  Wrench<calibration::Patient> on_hand{};   ///< about T's origin of the blade
  Wrench<calibration::Patient> on_piece{};  ///< normal forces, about the same
  double coupling_Nmm = 0.0;                ///< stored between hand and blade
  double twist_Nmm = 0.0;                   ///< of the hand on the blade about its z
  double blade_on_bone_N = 0.0;             ///< sums of normal forces; with other pieces of the tooth
  double blade_on_teeth_N = 0.0;            ///< on neighbours
  double blade_on_piece_N = 0.0;
  glm::dvec3 fulcrum_P_mm{0.0};  ///< middle of the pressure on bone and neighbours, if there is any
  Wedging wedging;
  double torn_Nmm = 0.0, stored_Nmm = 0.0, torn_share = 0.0;  ///< as HoldTick
  double residual_N = 0.0;
  int evaluations = 0;
  bool unsettled = false;  ///< not balanced within the evaluations; goes on from here next tick
  bool refused = false;    ///< input that is no number, or a period outside kLongestTick_s: nothing changed
};

class ElevatorHold {
 public:
  explicit ElevatorHold(ElevatorKind kind = ElevatorKind::straight_301, const ElevatorLaw& law = {}) noexcept
      : law_(law), shape_(elevatorShape(kind)) {}

  /// Another instrument, or the blade somewhere else: without friction. A pose that is no number is refused (false).
  bool take(ElevatorKind kind, const ToolPose& X_PT) noexcept;

  /// `piece` null: the blade alone. Its obstacles are the scene's; `scene.piece` is its own field.
  ElevatorTick step(const ElevatorHand& hand, const ElevatorScene& scene, PieceHold* piece, double period_s) noexcept;

  const ElevatorShape& shape() const noexcept { return shape_; }
  const ElevatorState& state() const noexcept { return state_; }
  void restore(const ElevatorState& state) noexcept { state_ = state; }
  /// Ticks that did not settle, since made.
  int unsettled() const noexcept { return unsettled_; }

 private:
  struct Tried;
  Tried tryAt(const ElevatorHand& hand, const ElevatorScene& scene, const PieceHold* piece, const ToolPose& X_PT,
              const PiecePose& X_PQ, double period_s) noexcept;
  void sayForces(const Tried& end, ElevatorTick& tick) const noexcept;

  ElevatorLaw law_;
  ElevatorShape shape_;
  ElevatorState state_;
  BladeContacts contacts_;  ///< of the tick
  int unsettled_ = 0;
};

/// How far blade and shank are from a piece, roughly (0.2 mm; its field's band at most): which piece an elevator is at.
double gapOf_mm(const ElevatorShape& shape, const ToolPose& X_PT, const DistanceField& piece,
                const PiecePose& X_PQ) noexcept;

}  // namespace haptics
