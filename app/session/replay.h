// Runs a recorded session again: the bone from its start, the servo over the recorded hands and commands, and every
// force, proxy, removed volume and bone digest compared bit for bit. No clock, no device, no thread of its own.
// Frame P. Any thread but the servo; takes what the servo's own work in it took.
// Bit-identical on any machine that runs the same program; another build of the servo may differ, and is told so.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/session/session_reader.h"
#include "haptics/bone/carved_bone.h"

namespace app {

struct ReplayDifference {
  std::uint64_t tick = 0;
  std::string what;  ///< "the force served differs", or why it can not be run
};

struct ReplayReport {
  std::uint64_t ticks = 0;     ///< in the file
  std::uint64_t replayed = 0;  ///< run again and found identical
  std::uint64_t lost = 0;      ///< made, but not in the file; known only of a closed session
  double duration_s = 0.0;
  bool closed = false;                         ///< false: the recording ended early, by a kill or a full disk
  std::optional<std::string> damage;           ///< the checksum chain is broken here: nothing was run
  std::optional<ReplayDifference> difference;  ///< nothing was run past it
  std::uint64_t bone_digest = 0;               ///< of the bone after the last tick replayed

  /// Every tick made is in the file and was found identical.
  bool verified() const { return !damage && !difference && lost == 0 && replayed == ticks; }
  /// For people: what was found.
  std::string line() const;
};

/// Throws SessionError if the file is missing or never was a session; a damaged one is a report.
ReplayReport verify(const std::string& path);

/// A moment of the rehearsal, brought back.
struct ReplayedMoment {
  StoredStart start;
  haptics::CarvedBone bone;  ///< what is left
  haptics::Tick tick;        ///< the last one run; default before the first
  haptics::Command command;  ///< in force
};

/// The state after every tick that began before `t_s`. Throws SessionError if the session is damaged or ticks before
/// that moment were lost.
ReplayedMoment replayTo(const std::string& path, double t_s);

}  // namespace app
