// How often and how long a bur, and no other instrument, touched teeth and the mandibular canal, from every tick, so
// that a touch shorter than a frame counts. Each touch that ended becomes an event of the recording, from which metrics
// makes the same numbers (app/session/touch_event). Main thread, once a frame; microseconds a tick, some tens of them
// while a tooth is touched.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "app/session/touch_event.h"
#include "assets/patient.h"
#include "assets/structure_distance.h"
#include "haptics/servo/tick.h"
#include "haptics/tool/tool.h"

namespace app {

/// Teeth (FDI numbers) with scanned hard tissue within the head and half a voxel of it, while the tick's contact is
/// with a tooth.
std::vector<int> teethTouched(const haptics::Tick& tick, const haptics::BurShape& head, const assets::Patient& patient);

class Touches {
 public:
  /// Borrows both.
  Touches(const assets::Patient& patient, const assets::StructureDistance& canal) : patient_(patient), canal_(canal) {}

  /// `ticks` in order, made with this tool. Returns the touches that ended.
  std::vector<Touch> follow(std::span<const haptics::Tick> ticks, const haptics::Tool& tool);
  /// At the end: those that are still on.
  std::vector<Touch> finish();

  /// Of all that ended, in the order of their first.
  const std::vector<TouchCount>& counts() const { return counts_; }

 private:
  struct Running {
    double last_s = 0.0, contact_s = 0.0;
  };
  void lookAt(const haptics::Tick& tick, const haptics::Tool& tool);
  void touch(const std::string& what, const haptics::Tick& tick) {
    Running& running = running_[what];
    running.last_s = tick.t_s;
    running.contact_s += tick.dt_s;
  }
  std::vector<Touch> endedBefore(double time_s);

  const assets::Patient& patient_;
  const assets::StructureDistance& canal_;
  std::map<std::string, Running> running_;
  std::vector<TouchCount> counts_;
};

}  // namespace app
