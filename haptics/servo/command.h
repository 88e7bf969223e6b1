// Input of the servo besides the hand: tool, law, erosion and limits as one value that passes through Latest<Command>.
// Trivially copyable. Recorded with each change, so a replay needs nothing else. Units in the names.
#pragma once

#include <cstdint>

#include "haptics/bone/erosion.h"
#include "haptics/contact/law.h"
#include "haptics/safety/safety_limits.h"
#include "haptics/servo/chip_removal.h"
#include "haptics/servo/piece_sites.h"
#include "haptics/servo/root_canal_file.h"
#include "haptics/servo/tooth_break.h"
#include "haptics/servo/tooth_split.h"
#include "haptics/tool/spindle.h"
#include "haptics/tool/tool.h"

namespace haptics {

struct Command {
  std::uint64_t serial = 0;      ///< rises by one with every change
  Tool tool;                     ///< for force, cutting and display
  bool drill_enabled = true;     ///< false: the pedal has no effect
  bool hands_off = false;        ///< as if no hand held the handle: force to zero, nothing works; then armed anew
  bool irrigating = true;        ///< water on the bur while it turns, drawn, not felt; washes root canals
  bool assistant_holds = false;  ///< lip, cheek and tongue aside: they give way; and a raised flap (app/procedure/flap)
  bool flap_aside = false;       ///< raised from closed gum and held: gum gives way, a bur on its edge is still told
  std::uint64_t undo_serial = 0;  ///< rises by one for every stroke to undo
  std::uint64_t redo_serial = 0;  ///< rises by one for every stroke to redo
  SplitOrder split;
  BreakOrder bridge;
  SiteOrder site;
  ChipOrder chips;
  LawSettings law;
  ErosionSettings erosion;
  SpindleSettings spindle;
  WearSettings wear;             ///< of a root canal by files
  FileReference file_reference;  ///< of their rubber stops
  SafetyLimits safety;
  std::uint64_t rearm = 0;  ///< a change clears a latched fault
};

}  // namespace haptics
