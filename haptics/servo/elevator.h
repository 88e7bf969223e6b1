// An elevator: a lever whose blade, between tooth and bone, loosens a piece of tooth when the hand twists, levers or
// pushes. Near pieces that are ready its blade is held off bone, teeth and pieces as a whole (ligament/elevator_hold);
// farther away the tool's tip and shaft meet them as a bur's do. From kReach_mm of a piece until it is kOff_mm away the
// blade works on it: both move together, in a stroke of their own (servo/luxation_strokes). One piece is worked on, the
// nearest; others stand still. While the pedal is down the blade keeps its roll and the hand may turn back. Frame P;
// N, N mm of the model unless said. Servo thread; no allocation, no throw; 5 us near a piece, 30 to 100 at work.
#pragma once

#include <cstddef>
#include <optional>

#include "haptics/ligament/elevator_hold.h"
#include "haptics/servo/led_tool.h"
#include "haptics/servo/piece_sites.h"
#include "haptics/tool/elevator_kind.h"

namespace haptics {

struct ElevatorReach {
  static constexpr double kNear_mm = 4.0, kFar_mm = 4.5;  ///< of a piece: within what a site knows
  static constexpr double kReach_mm = 0.3, kOff_mm = 0.6;
};

class Elevator {
 public:
  /// With nothing led; `blade_X_PT`: of the tool at the proxy. True: from now on the blade leads the tool.
  bool approach(const Bodies& bodies, const PieceSites& sites, ElevatorKind kind, const ToolPose& blade_X_PT,
                LedTool& led) noexcept;
  /// The piece that the blade comes to work on in this tick, which begins a stroke; none: already at work, or too far.
  std::optional<std::size_t> reach(const Bodies& bodies, const PieceSites& sites, LedTool& led) const noexcept;
  /// Moves blade and piece. `in_hand`: another kind or none ends it.
  void move(Bodies& bodies, PieceSites& sites, ElevatorKind in_hand, const ToolPose& hand_X_PT, bool keeps_roll,
            double dt_s, LedTool& led) noexcept;

 private:
  struct Near {
    std::size_t piece = 0;
    double gap_mm = 0.0;
  };
  /// Of those that are ready.
  static std::optional<Near> nearest(const Bodies& bodies, const PieceSites& sites, const ElevatorShape& shape,
                                     const ToolPose& X_PT) noexcept;
  ToolPose wanted(const ToolPose& hand_X_PT, bool keeps_roll) noexcept;

  ElevatorHold hold_;
  ElevatorKind kind_ = ElevatorKind::none;
  glm::dquat slack_{1.0, 0.0, 0.0, 0.0};  ///< roll of the blade's target against the hand's
  glm::dquat kept_{1.0, 0.0, 0.0, 0.0};   ///< the target's attitude when the pedal went down
  bool keeps_roll_ = false;
};

}  // namespace haptics
