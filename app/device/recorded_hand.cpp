#include "app/device/recorded_hand.h"

#include "app/session/session_reader.h"

namespace app {

std::unique_ptr<haptics::ReplayedHand> recordedHand(const std::string& session_path) {
  SessionReader session(session_path);
  std::vector<haptics::HandleState> states;
  for (TickBlock block = session.nextBlock(); !block.ticks.empty(); block = session.nextBlock())
    for (const haptics::Tick& tick : block.ticks) {
      haptics::HandleState state;
      state.X_DH = {tick.hand.X_PT.rotation, tick.hand.X_PT.translation_mm};
      state.velocity_D_mm_per_s.xyz = tick.hand.velocity_P_mm_per_s.xyz;
      state.pedal = tick.hand.drill_pedal;
      state.healthy = tick.hand.device_healthy;
      states.push_back(state);
    }
  return std::make_unique<haptics::ReplayedHand>(std::move(states), session.about().dt_s);
}

}  // namespace app
