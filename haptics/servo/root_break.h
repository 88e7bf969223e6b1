// A root or a crown that breaks under forceps or elevator: what it passes on (ligament/root_load) against what its
// sections bear (body/root_section), in two rounds one after the other, so that no single tick decides. What comes off
// is carried out by tooth_split. The sections are those of the piece's site in force. Frame P; N, N mm of the model.
// Servo thread; some 2 us a tick while a piece is held; no allocation, no throw.
#pragma once

#include "haptics/ligament/root_load.h"
#include "haptics/servo/piece_sites.h"
#include "haptics/servo/tooth_break.h"

namespace haptics {

class RootBreak {
 public:
  /// A tick in which an instrument moves this piece.
  void follow(const Bodies& bodies, const PieceSites& sites, std::size_t piece, const RootTool& tool,
              double dt_s) noexcept;
  /// A tick in which none is moved.
  void rest() noexcept;

  /// Of the last round: the largest share of what breaks a section; 0: none yet.
  double share() const { return share_; }
  /// Piece 0: none, in this tick. The caller parts the piece by plan() in this tick.
  const BrokenBridge& broken() const { return broken_; }
  const SplitPlan& plan() const { return *plan_; }

 private:
  static constexpr int kRounds = 2;
  RootLoad load_;
  const PieceSite* site_ = nullptr;  ///< that the round is of
  int over_ = 0;                     ///< rounds beyond what it bears
  double share_ = 0.0;
  BrokenBridge broken_;
  const SplitPlan* plan_ = nullptr;
};

}  // namespace haptics
