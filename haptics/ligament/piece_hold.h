// One piece of tooth held in its socket: where it goes in a tick under what drives it, against ligament, bone and
// neighbours. Quasi-static: the pose of least energy, found by Newton steps with drag; then fibres tear and creep,
// fluid flows, the socket widens. Frames P (obstacles) and Q (piece; at rest Q lies on P). mm, N, N mm (energies too:
// mJ), s. Servo thread: no allocation, lock or clock in step(); bounded by 6 evaluations of all samples, 15 to 40 µs
// for 2000. A pure function of state and inputs, the same bits on every machine. Method: reference/extraction 3.2
// to 3.4.
#pragma once

#include <span>

#include "haptics/body/distance_field.h"
#include "haptics/ligament/hold_kernels.h"
#include "haptics/ligament/piece_drive.h"
#include "haptics/ligament/piece_samples.h"
#include "haptics/ligament/settle.h"

namespace haptics {

/// All that a piece remembers, by value.
struct PieceState {
  PiecePose X_PQ;
  LigamentMemory ligament;
};

struct HoldTick {
  PiecePose X_PQ;
  Wrench<calibration::Patient> on_hand{};  ///< of the spring, torque about its grip
  double torn_Nmm = 0.0;                   ///< by this tick
  double stored_Nmm = 0.0;                 ///< in ligament and contact, after it
  double torn_share = 0.0;                 ///< of the ligament's area, 1 without ligament
  double residual_N = 0.0;                 ///< largest force, or torque over the lever, that is not balanced
  int evaluations = 0;
  bool unsettled = false;  ///< not balanced within the evaluations; goes on from here next tick
  bool refused = false;    ///< input that is no number, or a period outside kLongestTick_s: nothing changed
};

inline constexpr double kLongestTick_s = 0.05;

/// Ligament, wall and contact at a pose, without drive and drag.
struct HoldBalance {
  Balance balance;  ///< about the samples' centre
  double contact_Nmm = 0.0;
};

class PieceHold {
 public:
  /// Allocates.
  PieceHold(PieceSamples samples, const LigamentLaw& law);

  /// `obstacles` may be null: then each sample of ligament meets the plane of its own socket point and nothing else.
  HoldTick step(const PieceDrive& drive, const DistanceField* obstacles, double period_s) noexcept;

  /// For a solve together with other bodies: what holds the piece at a pose,
  HoldBalance balanceAt(const PiecePose& X_PQ, const DistanceField* obstacles, double period_s) const noexcept;
  /// and the piece where that solve had it, `contact_Nmm` of it: it tears, creeps, flows and widens its socket. Leaves
  /// evaluations, residual and on_hand of the tick empty.
  HoldTick moveTo(const PiecePose& X_PQ, const DistanceField* obstacles, double contact_Nmm, double period_s) noexcept;

  const PieceState& state() const noexcept { return state_; }
  /// A state of this piece (assert). No allocation.
  void restore(const PieceState& state) noexcept;
  /// The same from the values of a LigamentMemory, kept elsewhere.
  void restore(const PiecePose& X_PQ, std::span<const float> torn, std::span<const float> fluid_N_per_mm2,
               std::span<const float> strain, std::span<const float> widened_mm) noexcept;
  /// The same piece as another hold, in a socket that has changed since: its memory and pose; with other samples, as
  /// much torn everywhere. Null: a piece at this pose of which `torn_share` is torn everywhere. No allocation.
  void takeOver(const PieceHold* before, const PiecePose& X_PQ, double torn_share) noexcept;
  /// Bone was lost or came back. A change of these samples (assert). No allocation; torn shares only grow.
  void meet(const SocketChange& change) noexcept;

  const PieceSamples& samples() const noexcept { return samples_; }
  const LigamentLaw& law() const noexcept { return law_; }
  /// Of the ligament's area, 1 without ligament.
  double tornShare() const noexcept;
  /// Ticks that did not settle, since made.
  int unsettled() const noexcept { return unsettled_; }

  /// What the kernels read of the hold alone, without drive, at a pose; valid until the next change.
  struct KernelInput {
    HoldConstants law;
    HoldSamples samples;
    HoldPlace place;
  };
  KernelInput inputAt(const PiecePose& X_PQ, const DistanceField* obstacles, double period_s) const noexcept;

 private:
  struct Tried;
  HoldPlace placeAt(const PiecePose& X_PQ, const DistanceField* obstacles) const noexcept;
  HoldSamples view() const noexcept;
  HoldConstants constantsFor(double period_s) const noexcept;
  HoldBalance balanceAt(const PiecePose& X_PQ, const HoldConstants& constants,
                        const DistanceField* obstacles) const noexcept;
  Tried tryAt(const PiecePose& X_PQ, const HoldConstants& constants, const DistanceField* obstacles,
              const PieceDrive& drive, double drag_N_per_mm) const noexcept;
  PieceSamples samples_;
  LigamentLaw law_;
  HoldConstants constants_;
  double ligament_area_mm2_;
  PieceState state_;
  int unsettled_ = 0;
};

}  // namespace haptics
