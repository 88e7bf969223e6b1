#include "haptics/servo/luxation.h"

namespace haptics {

std::optional<std::size_t> Luxation::reach(const Bodies& bodies, const PieceSites& sites, const Tool& tool,
                                           const Hand& hand) noexcept {
  if (!led_.leads || !by_elevator_ || !tool.isElevator() || !hand.may_move) return {};
  return elevator_.reach(bodies, sites, led_);
}

void Luxation::move(Bodies& bodies, PieceSites& sites, const Tool& tool, const Hand& hand, double dt_s) noexcept {
  led_.max_stored_Nmm = 0.0;
  led_.unsettled = led_.set_aside = false;
  led_.lever = {};
  if (!led_.leads) return;
  if (by_elevator_)
    elevator_.move(bodies, sites, hand.may_move ? tool.elevator : ElevatorKind::none, hand.X_PT, hand.pedal, dt_s,
                   led_);
  else
    forceps_.move(bodies, sites, hand.X_PT, tool.grips && hand.pedal && hand.may_move, dt_s, led_);
}

bool Luxation::takeHold(const Bodies& bodies, const PieceSites& sites, const Tool& tool, const ToolPose& tool_X_PT,
                        const Hand& hand) noexcept {
  // Forceps follow the pedal also while another tool is in the hand.
  const bool closed = tool.grips && hand.pedal && hand.may_move;
  const bool grips = forceps_.grip(bodies, sites, tool.head.radius_mm, tool_X_PT, hand.X_PT, closed, led_);
  by_elevator_ =
      !grips && tool.isElevator() && hand.may_move && elevator_.approach(bodies, sites, tool.elevator, tool_X_PT, led_);
  return grips || by_elevator_;
}

}  // namespace haptics
