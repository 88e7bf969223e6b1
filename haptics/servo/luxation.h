// The instrument that moves pieces of tooth, forceps or elevator, whichever is in the hand: one piece leads one tool at
// a time. Frame P. Servo thread; no allocation, no throw; costs as theirs.
#pragma once

#include <cstddef>
#include <optional>

#include "haptics/servo/elevator.h"
#include "haptics/servo/forceps.h"
#include "haptics/servo/led_tool.h"
#include "haptics/servo/piece_sites.h"
#include "haptics/tool/tool.h"

namespace haptics {

class Luxation {
 public:
  struct Hand {
    ToolPose X_PT;
    bool pedal = false;    ///< closes forceps; keeps an elevator's roll while the hand turns back
    bool may_move = true;  ///< false: what leads lets go, nothing takes hold
  };

  /// The piece that is moved from this tick on, which begins a stroke, before anything moves.
  std::optional<std::size_t> reach(const Bodies& bodies, const PieceSites& sites, const Tool& tool,
                                   const Hand& hand) noexcept;
  /// Moves what is led, if anything, or lets go of it.
  void move(Bodies& bodies, PieceSites& sites, const Tool& tool, const Hand& hand, double dt_s) noexcept;
  /// With nothing led; `tool_X_PT`: at the proxy. True: from now on the tool is led.
  bool takeHold(const Bodies& bodies, const PieceSites& sites, const Tool& tool, const ToolPose& tool_X_PT,
                const Hand& hand) noexcept;

  /// What was held has broken: it stays where it is.
  void drop() noexcept { led_.leads = led_.holds = false; }

  bool leads() const { return led_.leads; }
  /// A piece moves with the tool.
  bool holds() const { return led_.leads && led_.holds; }
  /// Of the last step.
  const LedTool& led() const { return led_; }
  /// Pieces were put back.
  void lookAgain(const Bodies& bodies, const PieceSites& sites) noexcept {
    led_.torn_share = sites.tornShare(bodies, led_.piece);
  }

 private:
  Forceps forceps_;
  Elevator elevator_;
  bool by_elevator_ = false;
  LedTool led_;
};

}  // namespace haptics
