// Going on where a recorded rehearsal ended: its bone, case, tools and settings. Reads the session once, a second for
// some minutes; a killed one is replayed for its bone. Undo does not reach back into it. Main thread, start-up only.
#pragma once

#include <string>
#include <vector>

#include "app/session/drawn_plan_event.h"
#include "app/session/session_setup.h"
#include "assets/patient.h"
#include "haptics/servo/command.h"

namespace app {

struct Continuation {
  std::string path;
  SessionSetup setup;        ///< of the new session: `former` is this one
  DrawnPlan drawn;           ///< the surgeon's own
  haptics::Command command;  ///< in force at its end: tool, law, erosion, motor
  assets::VolumeGrid grid;
  std::vector<std::uint8_t> solid;  ///< the bone at its end, in the order of the grid
  std::vector<std::uint8_t> label;
  std::vector<std::uint8_t> whole;                ///< before the first session; empty: not known, as the case gives it
  std::optional<haptics::Filling::Volumes> laid;  ///< into a tooth, of any task; none: nothing is
  std::vector<std::string> remarks;               ///< for people

  /// Gives the patient the bone and returns the one before. Throws UsageError if it is not the patient of the session.
  std::vector<std::uint8_t> applyTo(assets::Patient& patient) const;
};

/// The lines that were drawn in a session, the last ones; empty: none. Throws SessionError.
DrawnPlan drawnPlanOf(const std::string& path);

/// Throws SessionError.
Continuation continuationOf(const std::string& path);

}  // namespace app
