#include "app/instructor/rehearsal_status.h"

#include <fmt/core.h>

#include "app/options/law_text.h"

namespace app {

const char* drillText(const RehearsalStatus& status) {
  const haptics::Tick& tick = status.tick;
  if (tick.drilling) return status.command.irrigating ? "drilling" : "drilling dry";
  if (tick.drill_inhibit == haptics::DrillInhibit::undo_running) return "undo is running";
  if (tick.drill_inhibit == haptics::DrillInhibit::tool_embedded) return "no force, withdraw the bur from the bone";
  if (tick.drill_inhibit == haptics::DrillInhibit::pedal_held) return "drill stopped until the pedal is released";
  return status.command.drill_enabled ? "drill off" : "drill locked";
}

std::string statusLine(const RehearsalStatus& s) {
  if (s.tick.state != haptics::SafetyState::active) {
    const haptics::StateText& text = haptics::textOf(s.tick.state);
    return "Molar   " + std::string(text.what) + " " + std::string(text.next);
  }
  const std::string lead = s.recording == RecordingState::ended_early ? "Molar   NOT RECORDING   " : "Molar   ";
  if (!s.to_surgeon.empty()) return lead + s.to_surgeon;
  return lead +
         fmt::format(
             "{:.1f} s   {}   force {:.2f} N   depth {:.2f} mm   {}   servo p99 {:.0f} µs   {:.0f} frames/s, {}   "
             "motion to photon {:.0f} ms",
             s.tick.t_s, lawName(s.command.law.kind), glm::length(s.tick.commanded_force_P_N.xyz), s.tick.depth_mm,
             drillText(s), s.servo.work_p99_us, s.frames_per_s, s.quality, s.latency.total_ms());
}

}  // namespace app
