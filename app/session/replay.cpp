#include "app/session/replay.h"

#include <bit>
#include <cstdio>
#include <span>

#include "app/session/file_seal.h"
#include "app/session/session_error.h"
#include "haptics/servo/servo.h"

namespace app {
namespace {

bool same(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }
bool same(const glm::dvec3& a, const glm::dvec3& b) { return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z); }

/// Says in which quantity a tick run again first differs from the recorded one.
std::optional<std::string> differenceOf(const haptics::Tick& recorded, const haptics::Tick& again) {
  if (recorded.index != again.index) return "the number of the tick differs";
  if (!same(recorded.t_s, again.t_s) || !same(recorded.dt_s, again.dt_s)) return "the time differs";
  if (recorded.command_serial != again.command_serial) return "the command in force differs";
  if (!same(recorded.proxy_P.mm, again.proxy_P.mm)) return "the proxy differs";
  if (!same(recorded.law_force_P_N.xyz, again.law_force_P_N.xyz)) return "the force of the law differs";
  if (!same(recorded.served_force_P_N.xyz, again.served_force_P_N.xyz)) return "the force served differs";
  if (!same(recorded.law_torque_P_Nmm.xyz, again.law_torque_P_Nmm.xyz)) return "the torque of the law differs";
  if (!same(recorded.served_torque_P_Nmm.xyz, again.served_torque_P_Nmm.xyz)) return "the torque served differs";
  if (!same(recorded.energy_Nmm, again.energy_Nmm)) return "the energy differs";
  if (!same(recorded.spindle_rad_per_s, again.spindle_rad_per_s)) return "the speed of the spindle differs";
  if (!same(recorded.overlap_mm3, again.overlap_mm3)) return "the overlap differs";
  if (!same(recorded.depth_mm, again.depth_mm)) return "the depth differs";
  if (!same(recorded.removed_mm3, again.removed_mm3)) return "the removed volume differs";
  if (recorded.bone_digest != again.bone_digest) return "the bone differs";
  if (recorded.contact_tissue != again.contact_tissue) return "the tissue in contact differs";
  if (recorded.drilling != again.drilling || recorded.rest != again.rest) return "the drill differs";
  if (recorded.strokes != again.strokes) return "the strokes to take back differ";
  if (recorded.state != again.state) return "the state of the safety layer differs";
  if (recorded.faults != again.faults) return "the faults differ";
  return std::nullopt;
}

/// The servo on the bone of the start, fed with what was recorded.
class Rerun {
 public:
  Rerun(haptics::CarvedBone& bone, std::vector<SessionCommand> commands)
      : servo_(bone), commands_(std::move(commands)) {}

  /// Moves on to the command recorded as in force at this tick; false if the session has none of that serial.
  bool obey(const haptics::Tick& recorded) {
    while (next_ < commands_.size() && commands_[next_].first_tick <= recorded.index) {
      command_ = commands_[next_++].command;
    }
    return command_.serial == recorded.command_serial;
  }
  haptics::Tick step(const haptics::Tick& recorded) { return servo_.step(recorded.hand, command_, recorded.dt_s); }
  const haptics::Command& command() const { return command_; }

 private:
  haptics::Servo servo_;
  std::vector<SessionCommand> commands_;
  haptics::Command command_;
  std::size_t next_ = 0;
};

std::optional<std::string> stepDifference(Rerun& rerun, const haptics::Tick& recorded, std::uint64_t next_index,
                                          haptics::Tick& again) {
  if (recorded.index != next_index) return std::to_string(recorded.index - next_index) + " ticks before it were lost";
  if (!rerun.obey(recorded)) return "its command was not recorded";
  again = rerun.step(recorded);
  return differenceOf(recorded, again);
}

/// What there is to say of a session that can be opened.
ReplayReport verifyReadable(const std::string& path) {
  SessionReader session(path);
  ReplayReport report;
  report.closed = session.closed();
  report.lost = session.lost();
  report.damage = session.damage();
  if (report.damage) return report;

  const StoredStart start = session.start();
  haptics::CarvedBone bone(start.grid, start.solid, start.label);
  Rerun rerun(bone, session.commands());
  for (auto block = session.nextTicks(); !block.empty(); block = session.nextTicks()) {
    for (const haptics::Tick& recorded : block) {
      ++report.ticks;
      report.duration_s = recorded.t_s + recorded.dt_s;
      if (report.difference) continue;
      haptics::Tick again;
      if (auto what = stepDifference(rerun, recorded, report.replayed, again)) {
        report.difference = ReplayDifference{recorded.index, *what};
      } else {
        ++report.replayed;
      }
    }
  }
  report.bone_digest = bone.digest();
  return report;
}

}  // namespace

std::string ReplayReport::line() const {
  if (damage) return "NOT verified: the file was changed: " + *damage;
  char figures[96];
  std::snprintf(figures, sizeof figures, "%llu ticks, %.3f s", static_cast<unsigned long long>(ticks), duration_s);
  std::string ended;
  if (lost > 0) ended += "; " + std::to_string(lost) + " ticks were lost";
  if (!closed) ended += "; the recording ended early (killed, or the disk was full) and is whole up to there";
  if (difference) {
    return "NOT verified: at tick " + std::to_string(difference->tick) + " " + difference->what + " (of " + figures +
           ")" + ended;
  }
  if (!verified()) return std::string("NOT verified: ") + figures + ", all of them bit-identical" + ended;
  char digest[17];
  std::snprintf(digest, sizeof digest, "%016llx", static_cast<unsigned long long>(bone_digest));
  return std::string("verified: ") + figures + ", every force and the final bone (" + digest + ") bit-identical" +
         ended;
}

ReplayReport verify(const std::string& path) {
  try {
    return verifyReadable(path);
  } catch (const SessionError& refusal) {
    // A session too damaged to be read is an answer; a file that never was one is bad input.
    if (!bearsSessionMark(path)) throw;
    ReplayReport report;
    report.damage = refusal.what();
    return report;
  }
}

ReplayedMoment replayTo(const std::string& path, double t_s) {
  SessionReader session(path);
  if (const auto damage = session.damage()) {
    throw SessionError(path + ": is damaged (" + *damage + "): see `molar replay " + path + " --verify`");
  }
  StoredStart start = session.start();
  haptics::CarvedBone bone(start.grid, start.solid, start.label);
  Rerun rerun(bone, session.commands());
  haptics::Tick last;
  std::uint64_t next_index = 0;
  for (auto block = session.nextTicks(); !block.empty() && block.front().t_s < t_s; block = session.nextTicks()) {
    for (const haptics::Tick& recorded : block) {
      if (!(recorded.t_s < t_s)) break;
      if (auto what = stepDifference(rerun, recorded, next_index++, last)) {
        throw SessionError(path + ": can not be run again past tick " + std::to_string(recorded.index) + " (" + *what +
                           "): ask for an earlier moment");
      }
    }
  }
  const haptics::Command command = rerun.command();
  return {std::move(start), std::move(bone), last, command};
}

}  // namespace app
