#include "app/instructor/rehearsal_status.h"

namespace app {

const char* drillText(const RehearsalStatus& status) {
  const haptics::Tick& tick = status.tick;
  if (tick.drilling) return status.command.irrigating ? "drilling" : "drilling dry";
  if (tick.drill_inhibit == haptics::DrillInhibit::undo_running) return "undo is running";
  if (tick.drill_inhibit == haptics::DrillInhibit::tool_embedded) return "no force, withdraw the bur from the bone";
  if (tick.drill_inhibit == haptics::DrillInhibit::pedal_held) return "drill stopped until the pedal is released";
  return status.command.drill_enabled ? "drill off" : "drill locked";
}

}  // namespace app
