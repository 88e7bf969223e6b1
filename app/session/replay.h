// Replays a recorded session: the servo runs again on the initial bone with the recorded hand and commands, and every
// force, proxy, removed volume and bone digest is compared bit for bit. No clock, device or thread. Frame P. Any thread
// but the servo; takes the CPU time of the recorded servo steps.
// Bits agree only for one servo revision on one kind of processor (servo_build.h); other sessions are checked and read
// but not compared.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/session/session_reader.h"
#include "haptics/body/bodies.h"

namespace app {

/// Throws SessionError, one line, if a stored byte was changed. Reads it all.
void refuseDamaged(SessionReader& session, const std::string& path);

struct ReplayDifference {
  std::uint64_t tick = 0;
  std::string what;  ///< "the force served differs", or why it cannot be run
};

struct ReplayReport {
  std::uint64_t ticks = 0;     ///< in the file
  std::uint64_t replayed = 0;  ///< replayed and identical
  std::uint64_t lost = 0;      ///< not in the file
  double duration_s = 0.0;
  bool closed = false;                         ///< false: ended by a kill or a full disk
  std::optional<std::string> damage;           ///< where the checksum chain breaks: nothing was run
  bool unsealed = false;                       ///< closed, but without seal, as after a power cut
  std::optional<std::string> missing_log;      ///< killed, and this log of it is missing
  std::optional<std::string> not_comparable;   ///< another version or processor: nothing was run
  std::optional<ReplayDifference> difference;  ///< the replay stops there
  std::uint64_t bone_digest = 0;               ///< of the bone after the last tick replayed

  /// No tick is lost, and all are identical where they are comparable.
  bool verified() const {
    return !damage && !difference && !missing_log && lost == 0 && (not_comparable || replayed == ticks);
  }
  /// The result for people, one line.
  std::string line() const;
};

/// Throws SessionError if the file is missing or not a session; a damaged session is reported.
ReplayReport verify(const std::string& path);

/// The state of a rehearsal at one time.
struct ReplayedState {
  StoredStart start;
  haptics::Bodies bodies;    ///< what remains
  haptics::Tick tick;        ///< the last one replayed; default before the first
  haptics::Command command;  ///< current
  /// The first difference, if the bone is not the recorded one because of it: lost ticks, or another version.
  std::optional<ReplayDifference> divergence;
  double removed_excess_mm3 = 0.0;  ///< by then, compared with the recording
};

/// The state after every tick that began before `t_s`; continues past differences and losses. Rewinds the session,
/// which must be undamaged.
ReplayedState replayTo(SessionReader& session, double t_s);

/// The bone that a session left in the mouth.
struct BoneLeft {
  std::vector<std::uint8_t> solid;                ///< in the order of the grid
  std::optional<haptics::Filling::Volumes> laid;  ///< into a tooth, without ages; none: nothing is
  std::optional<RemovedByTissue> removed_mm3;     ///< by the replay; none: the bone is as recorded, without one
  std::optional<ReplayDifference> divergence;     ///< why the replay ended with another bone than the recording
  std::vector<std::string> remarks;               ///< for people: that it was replayed, and how exact that is
};

/// What lies in a tooth; none: nothing does.
std::optional<haptics::Filling::Volumes> laidIn(const haptics::Bodies& bodies);

/// As recorded, else by a replay. `start` is that of this session, which must be undamaged and is rewound.
BoneLeft boneLeft(SessionReader& session, const StoredStart& start);

/// The bone at a time.
struct BoneAtTime {
  StoredStart start;
  std::vector<std::uint8_t> solid;                ///< in the order of the grid
  std::optional<haptics::Filling::Volumes> laid;  ///< into a tooth; ages are those of the end; none: nothing is
  std::vector<assets::MetalFragment> fragments;   ///< of files that broke, in it
  double t_s = 0.0;
  std::vector<std::string> remarks;  ///< for people: that it was replayed, and how exact that is
};

/// The solid with what was laid into it.
std::vector<std::uint8_t> withLaid(std::vector<std::uint8_t> solid,
                                   const std::optional<haptics::Filling::Volumes>& laid);
/// The tissue of each voxel; of a filling where it is the larger part.
std::vector<std::uint8_t> labelsWithLaid(const BoneAtTime& bone);

/// The final bone if `t_s` is none or past the end: as recorded, else by a replay. Throws SessionError if the session
/// is damaged, or its log is missing and needed.
BoneAtTime boneAtTime(const std::string& path, std::optional<double> t_s);

}  // namespace app
