// How near the tool is to nerve and neighbours during a rehearsal: of the newest tick for the picture, the warning and
// the instructor; and over every tick with the drill on, as the recording is measured later
// (session/measures/clearance_measures). Main thread, once a frame; 5 to 20 µs, and some microseconds a tick.
#pragma once

#include <span>

#include "app/session/measures/clearance_measures.h"
#include "app/view/head_up_line.h"
#include "haptics/servo/command.h"
#include "haptics/servo/tick.h"

namespace app {

class ClearanceWatch {
 public:
  /// Borrowed.
  explicit ClearanceWatch(const assets::RiskStructures& risks) : risks_(risks), measures_(risks) {}

  /// All ticks, in order; `command` in force now, with the number that ticks tell of it.
  void follow(std::span<const haptics::Tick> ticks, const haptics::Command& command, std::uint64_t serial);
  /// Forceps are near to nothing: what is between their beaks is to go.
  void update(const haptics::Tick& newest, const haptics::Tool& tool);

  const haptics::Clearances& now() const { return now_; }
  std::optional<double> canal_mm() const { return now_[static_cast<std::size_t>(assets::RiskStructure::canal)]; }
  /// Those within their bands, the most urgent first: for the ruler in the picture.
  /// `proposed`: what nobody has confirmed.
  std::vector<HeadUpClearance> ruler(const assets::Proposed& proposed) const;
  const ClearanceMeasures& measures() const { return measures_; }

 private:
  const assets::RiskStructures& risks_;
  ClearanceMeasures measures_;
  haptics::Clearances now_;
  haptics::Tool tool_, former_;
  std::uint64_t serial_ = 0;  ///< of the command with `tool_`
};

}  // namespace app
