// `replay:SESSION`: the hand of a recorded session. X_DH is its X_PT: the frame of the device is the patient's.

#include "app/device/pose_sources.h"
#include "app/session/session_reader.h"
#include "haptics/device/simulated/replay_device.h"

namespace app {

PoseSource openReplay(const std::string& path, const PoseSourceContext&) {
  SessionReader session(path);
  std::vector<haptics::HandleState> states;
  for (TickBlock block = session.nextBlock(); !block.ticks.empty(); block = session.nextBlock())
    for (const haptics::Tick& tick : block.ticks) {
      haptics::HandleState& state = states.emplace_back();
      state.X_DH = {tick.hand.X_PT.rotation, tick.hand.X_PT.translation_mm};
      state.velocity_D_mm_per_s.xyz = tick.hand.velocity_P_mm_per_s.xyz;
      state.pedal = tick.hand.drill_pedal;
      state.healthy = tick.hand.device_healthy;
    }
  auto recorded = std::make_unique<haptics::ReplayDevice>(std::move(states), session.about().dt_s);
  PoseSource hand;
  hand.duration_s = recorded->duration_s();
  hand.rate_Hz = recorded->rate_Hz();
  hand.device = std::move(recorded);
  return hand;
}

}  // namespace app
