// Runs a recorded session again: the bone from its start, the servo over the recorded hands and commands, and every
// force, proxy, removed volume and bone digest compared bit for bit. No clock, no device, no thread of its own.
// Frame P. Any thread but the servo; takes what the servo's own work in it took.
// The bits are promised for one revision of the servo on one kind of processor (servo_build.h); the session of another
// is checked and read, not compared. What was recorded of the bone needs no re-run.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/session/session_reader.h"
#include "haptics/bone/carved_bone.h"

namespace app {

/// Throws SessionError, one line, if a stored byte was changed. Reads it all.
void refuseDamaged(SessionReader& session, const std::string& path);

struct ReplayDifference {
  std::uint64_t tick = 0;
  std::string what;  ///< "the force served differs", or why it can not be run
};

struct ReplayReport {
  std::uint64_t ticks = 0;     ///< in the file
  std::uint64_t replayed = 0;  ///< run again and found identical
  std::uint64_t lost = 0;      ///< made, but not in the file
  double duration_s = 0.0;
  bool closed = false;                         ///< false: the recording ended early, by a kill or a full disk
  std::optional<std::string> damage;           ///< the checksum chain is broken here: nothing was run
  bool unsealed = false;                       ///< closed, but its seal is missing, as after a power cut
  std::optional<std::string> missing_log;      ///< killed, and this second file of it is not there
  std::optional<std::string> not_comparable;   ///< "recorded by another version …", or processor: nothing was run
  std::optional<ReplayDifference> difference;  ///< nothing was run past it
  std::uint64_t bone_digest = 0;               ///< of the bone after the last tick replayed

  /// Every tick made is in the file, and was found identical where that can be asked.
  bool verified() const {
    return !damage && !difference && !missing_log && lost == 0 && (not_comparable || replayed == ticks);
  }
  /// For people: what was found.
  std::string line() const;
};

/// Throws SessionError if the file is missing or never was a session; a damaged one is a report.
ReplayReport verify(const std::string& path);

/// A moment of the rehearsal, brought back.
struct ReplayedState {
  StoredStart start;
  haptics::CarvedBone bone;  ///< what is left
  haptics::Tick tick;        ///< the last one run; default before the first
  haptics::Command command;  ///< in force
  /// Where the run first departed from the recording, if it did and the bone is not the recorded one for it: by what
  /// was lost, or by another version of the program.
  std::optional<ReplayDifference> divergence;
  double removed_excess_mm3 = 0.0;  ///< by then, against the recording
};

/// The state after every tick that began before `t_s`. Runs on past differences and losses: the divergence tells.
/// Of a session that was found undamaged; from its beginning, wherever it was read to.
ReplayedState replayTo(SessionReader& session, double t_s);

/// The bone at a moment; as it was left where none is named or it lies past the end.
struct BoneAtTime {
  StoredStart start;
  std::vector<std::uint8_t> solid;  ///< in the order of its grid
  double t_s = 0.0;
  std::vector<std::string> remarks;  ///< for people: that it was run again, and how true that is
};

/// As it was recorded at the close, else run again. Throws SessionError if the session is damaged, or was killed and
/// its log, in which that moment lies, is not there.
BoneAtTime boneAtTime(const std::string& path, std::optional<double> t_s);

}  // namespace app
