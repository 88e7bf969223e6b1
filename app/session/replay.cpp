#include "app/session/replay.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <deque>
#include <limits>
#include <memory>
#include <utility>

#include <fmt/core.h>

#include "app/session/session_error.h"
#include "app/text/version.h"
#include "haptics/body/bridge_break.h"
#include "haptics/body/chip_search.h"
#include "haptics/body/piece_split.h"
#include "haptics/ligament/piece_site.h"
#include "haptics/servo/servo.h"

namespace app {
namespace {

bool same(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }
bool same(const glm::dvec3& a, const glm::dvec3& b) { return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z); }

bool same(const haptics::SoftTouch& a, const haptics::SoftTouch& b) {
  return a.tissue == b.tissue && a.bur_cuts == b.bur_cuts && a.tissues == b.tissues && same(a.depth_mm, b.depth_mm) &&
         same(a.place_P.mm, b.place_P.mm) && same(a.force_P_N.xyz, b.force_P_N.xyz) &&
         same(a.torque_P_Nmm.xyz, b.torque_P_Nmm.xyz) && same(a.turn_P.w, b.turn_P.w) &&
         same(glm::dvec3(a.turn_P.x, a.turn_P.y, a.turn_P.z), glm::dvec3(b.turn_P.x, b.turn_P.y, b.turn_P.z));
}

/// The first quantity in which a replayed tick differs from the recorded one.
std::optional<std::string> differenceOf(const haptics::Tick& recorded, const haptics::Tick& again) {
  if (recorded.index != again.index) return "the number of the tick differs";
  if (!same(recorded.t_s, again.t_s) || !same(recorded.dt_s, again.dt_s)) return "the time differs";
  if (recorded.command_serial != again.command_serial) return "the command in force differs";
  if (!same(recorded.proxy_P.mm, again.proxy_P.mm)) return "the proxy differs";
  if (!same(recorded.law_force_P_N.xyz, again.law_force_P_N.xyz)) return "the force of the law differs";
  if (!same(recorded.commanded_force_P_N.xyz, again.commanded_force_P_N.xyz)) return "the force served differs";
  if (!same(recorded.law_torque_P_Nmm.xyz, again.law_torque_P_Nmm.xyz)) return "the torque of the law differs";
  if (!same(recorded.commanded_torque_P_Nmm.xyz, again.commanded_torque_P_Nmm.xyz)) return "the torque served differs";
  if (!same(recorded.energy_Nmm, again.energy_Nmm)) return "the energy differs";
  if (!same(recorded.spindle_rad_per_s, again.spindle_rad_per_s)) return "the speed of the spindle differs";
  if (!same(recorded.overlap_mm3, again.overlap_mm3)) return "the overlap differs";
  if (!same(recorded.depth_mm, again.depth_mm)) return "the depth differs";
  if (!same(recorded.removed_mm3, again.removed_mm3)) return "the removed volume differs";
  if (recorded.bone_digest != again.bone_digest) return "the bone differs";
  if (recorded.contact_tissue != again.contact_tissue) return "the tissue in contact differs";
  if (!same(recorded.soft, again.soft)) return "the contact with soft tissue differs";
  if (recorded.drilling != again.drilling || recorded.drill_inhibit != again.drill_inhibit) return "the drill differs";
  if (recorded.strokes != again.strokes || recorded.undone_strokes != again.undone_strokes)
    return "the strokes to undo or redo differ";
  if (recorded.split != again.split) return "the splitting of the tooth differs";
  if (recorded.bridge != again.bridge || !same(recorded.bridge_share, again.bridge_share) ||
      recorded.broken != again.broken)
    return "the breaking of the bridge differs";
  if (recorded.chips != again.chips) return "the chips that came loose differ";
  if (recorded.site != again.site || recorded.gripped != again.gripped || recorded.set_aside != again.set_aside)
    return "the grip of the forceps differs";
  if (!same(recorded.grip_force_P_N.xyz, again.grip_force_P_N.xyz) ||
      !same(recorded.grip_torque_P_Nmm.xyz, again.grip_torque_P_Nmm.xyz))
    return "the force of the forceps differs";
  if (!(recorded.lever == again.lever)) return "the work of the elevator differs";
  if (!same(recorded.torn_share, again.torn_share) || !same(recorded.torn_total_Nmm, again.torn_total_Nmm))
    return "the tearing of the ligament differs";
  if (!same(recorded.restored_total_mm3, again.restored_total_mm3)) return "the restored volume differs";
  if (recorded.state != again.state) return "the state of the safety layer differs";
  if (recorded.faults != again.faults) return "the faults differ";
  return std::nullopt;
}

/// The servo on the initial bone, driven by the recorded hand and commands.
class Rerun {
 public:
  /// Borrows bodies and soft tissue.
  Rerun(haptics::Bodies& bodies, const assets::SoftTissueField& soft_tissue, std::vector<SessionCommand> commands)
      : bodies_(bodies), sockets_(bodies), servo_(bodies, &soft_tissue), commands_(std::move(commands)) {
    if (std::ranges::any_of(commands_, [](const SessionCommand& one) { return one.command.chips.serial != 0; }))
      first_.emplace(bodies);
  }

  /// Selects the command of this tick. Returns why the tick cannot be compared: lost ticks, or a missing command.
  std::optional<std::string> prepare(const haptics::Tick& recorded) {
    const std::uint64_t lost = recorded.index - std::exchange(next_index_, recorded.index + 1);
    // Of several for one tick the servo sees the last.
    const haptics::Command before = command_;
    while (next_ < commands_.size() && commands_[next_].first_tick <= recorded.index)
      command_ = commands_[next_++].command;
    command_.split.plan = command_.split.serial == before.split.serial ? before.split.plan : planFor(command_.split);
    command_.bridge.plan =
        command_.bridge.serial == before.bridge.serial ? before.bridge.plan : breakFor(command_.bridge);
    command_.site.site = command_.site.serial == before.site.serial ? before.site.site : siteFor(command_.site);
    command_.chips.plan = command_.chips.serial == before.chips.serial ? before.chips.plan : chipsFor(command_.chips);
    if (lost > 0) return std::to_string(lost) + " ticks before it were lost";
    if (command_.serial != recorded.command_serial) return "its command was not recorded";
    return std::nullopt;
  }
  haptics::Tick step(const haptics::Tick& recorded) {
    const haptics::Tick tick = servo_.step(recorded.hand, command_, recorded.dt_s);
    grips_ = tick.gripped != 0 || tick.lever.piece != 0;
    return tick;
  }
  const haptics::Command& command() const { return command_; }

 private:
  /// Made again from the bodies as they are: an order holds for these or not at all.
  const haptics::SplitPlan* planFor(const haptics::SplitOrder& order) {
    if (order.piece >= bodies_.pieces() || order.bodies_digest != bodies_.digest()) return nullptr;
    const haptics::CarvedBone& piece = bodies_.bones()[order.piece + 1];
    plans_.push_back(haptics::partingPlan({piece.grid(), piece.solidInGridOrder()}));
    return &plans_.back();
  }

  const haptics::BreakPlan* breakFor(const haptics::BreakOrder& order) {
    if (order.piece >= bodies_.pieces() || order.bodies_digest != bodies_.digest()) return nullptr;
    const haptics::CarvedBone& piece = bodies_.bones()[order.piece + 1];
    auto plan = haptics::breakPlan({piece.grid(), piece.solidInGridOrder()}, piece.labelInGridOrder(), order.bridge);
    return plan ? &breaks_.emplace_back(std::move(*plan)) : nullptr;
  }

  /// Found again from what has changed since the last search.
  const haptics::ChipPlan* chipsFor(const haptics::ChipOrder& order) {
    if (order.bodies_digest != bodies_.digest()) return nullptr;
    if (!search_) {
      search_.emplace(*first_);
      first_.reset();
    }
    std::vector<glm::ivec3> bricks;
    bodies_.takeDirtyBricks(bricks);
    for (const glm::ivec3& brick : bricks) haptics::giveBrick(bodies_, brick, *search_);
    return &chips_.emplace_back(search_->plan());
  }

  haptics::PieceSite* siteFor(const haptics::SiteOrder& order) {
    if (order.piece >= bodies_.pieces() || order.bodies_digest != bodies_.digest() || grips_) return nullptr;
    std::array<haptics::PiecePose, haptics::kMaxPieces> X_PQ;
    for (std::size_t n = 0; n < X_PQ.size(); ++n) X_PQ[n] = bodies_.pose(n);
    // The servo takes over every order that gets here, and needs the one before until then.
    std::deque<std::unique_ptr<haptics::PieceSite>>& sites = sites_[order.piece];
    const haptics::SocketScene scene = sockets_.scene(order.piece, X_PQ);
    // Of a stranger's file: a field has at least a cell.
    if (glm::any(glm::lessThan(scene.around_grid.size, glm::ivec3(2)))) return nullptr;
    if (!first_socket_) first_socket_.emplace(sockets_.firstSocket());
    sites.push_back(haptics::makePieceSite(scene, *first_socket_));
    if (sites.size() > 2) sites.pop_front();
    return sites.back().get();
  }

  haptics::Bodies& bodies_;
  haptics::SocketSource sockets_;
  std::optional<haptics::DistanceField> first_socket_;  ///< none: not needed yet
  std::array<std::deque<std::unique_ptr<haptics::PieceSite>>, haptics::kMaxPieces> sites_;
  haptics::Servo servo_;
  std::vector<SessionCommand> commands_;
  std::deque<haptics::SplitPlan> plans_;
  std::deque<haptics::BreakPlan> breaks_;
  std::optional<haptics::FirstBytes> first_;  ///< none: no chips are looked for, or search_ has them
  std::optional<haptics::ChipSearch> search_;
  std::deque<haptics::ChipPlan> chips_;
  haptics::Command command_;
  std::size_t next_ = 0;
  std::uint64_t next_index_ = 0;
  bool grips_ = false;
};

/// Compares what is stored apart from the ticks: the removed volume by tissue after a block, and the final bone.
std::optional<std::string> blockDifference(const TickBlock& block, const haptics::Tick& again) {
  if (block.removed_mm3 && *block.removed_mm3 != removedByKey(again.removed_total_mm3))
    return "the removed volume by tissue differs";
  return std::nullopt;
}

std::optional<std::string> finalBoneDifference(SessionReader& session, const StoredStart& start,
                                               const haptics::Bodies& bodies) {
  const auto left = session.finalBone(start);
  if (left && (left->digest != bodies.digest() || left->solid != bodies.solidInMouth()))
    return "the final bone differs";
  return std::nullopt;
}

void rerunAll(SessionReader& session, ReplayReport& report) {
  const StoredStart start = session.start();
  haptics::Bodies bodies(start.grid, start.solid, start.label, start.is_tooth);
  Rerun rerun(bodies, start.soft_tissue, session.commands());
  haptics::Tick again;
  for (TickBlock block = session.nextBlock(); !block.ticks.empty(); block = session.nextBlock()) {
    for (const haptics::Tick& recorded : block.ticks) {
      ++report.ticks;
      report.duration_s = recorded.t_s + recorded.dt_s;
      if (report.difference) continue;
      auto what = rerun.prepare(recorded);
      if (!what) {
        again = rerun.step(recorded);
        what = differenceOf(recorded, again);
      }
      if (!what && &recorded == &block.ticks.back()) what = blockDifference(block, again);
      if (what)
        report.difference = ReplayDifference{recorded.index, *what};
      else
        ++report.replayed;
    }
  }
  if (!report.difference && report.closed)
    if (const auto what = finalBoneDifference(session, start, bodies))
      report.difference = ReplayDifference{again.index, *what};
  report.bone_digest = bodies.digest();
}

void readThrough(SessionReader& session, ReplayReport& report) {
  for (TickBlock block = session.nextBlock(); !block.ticks.empty(); block = session.nextBlock()) {
    report.ticks += block.ticks.size();
    report.duration_s = block.ticks.back().t_s + block.ticks.back().dt_s;
  }
}

/// None: this program computes the same bits.
std::optional<std::string> whyNotComparable(const StoredStart& recorded) {
  const ServoBuild own = thisServo();
  if (recorded.servo.revision != own.revision)
    return fmt::format("recorded by another version ({} with servo revision {}, this is {} with {})",
                       recorded.program_version, recorded.servo.revision, programVersion(), own.revision);
  if (!recorded.servo.sumsIdentically(own))
    return "recorded with another instruction set (" + recorded.servo.instruction_set + ", this is " +
           own.instruction_set + ", see MOLAR_INSTRUCTIONS)";
  return std::nullopt;
}

ReplayReport verifyReadable(const std::string& path) {
  SessionReader session(path);
  ReplayReport report;
  report.closed = session.closed();
  report.missing_log = session.missingLog();
  report.damage = session.damage();
  if (report.damage) return report;
  report.unsealed = session.isUnsealed();

  report.not_comparable = whyNotComparable(session.about());
  report.not_comparable ? readThrough(session, report) : rerunAll(session, report);
  report.lost = session.lost();
  return report;
}

std::string divergenceText(const ReplayedState& state) {
  return fmt::format(
      "the replay differs from the recording from tick {} on ({}): {:.3f} mm³ {} of the bone is removed than recorded; "
      "use the version that recorded it for the exact bone",
      state.divergence->tick, state.divergence->what, std::abs(state.removed_excess_mm3),
      state.removed_excess_mm3 < 0.0 ? "less" : "more");
}

}  // namespace

void refuseDamaged(SessionReader& session, const std::string& path) {
  if (const auto damage = session.damage())
    throw SessionError(path + ": is damaged (" + *damage + "): see `molar replay " + path + " --verify`",
                       SessionErrorKind::damaged);
}

std::string ReplayReport::line() const {
  if (damage) return "NOT verified: the file was changed: " + *damage;
  const std::string figures = fmt::format("{} ticks, {:.3f} s", ticks, duration_s);
  std::string ended;
  if (lost > 0) ended += "; " + std::to_string(lost) + " ticks were lost";
  if (!closed) ended += "; the recording ended early (killed, or disk full) and is complete up to that point";
  if (unsealed) ended += "; its seal is missing, as after a power cut: every row was checked instead";
  if (missing_log)
    return "NOT verified: " + figures + "; its program was killed while recording, and its log " + *missing_log +
           " is not next to it: copy both files";
  if (difference) {
    return "NOT verified: at tick " + std::to_string(difference->tick) + " " + difference->what + " (of " + figures +
           ")" + ended;
  }
  if (not_comparable)
    return (lost > 0 ? "NOT verified: " : "checksums right: ") + figures + "; " + *not_comparable +
           ": values are read, a replay is not comparable" + ended;
  if (!verified()) return "NOT verified: " + figures + ", all of them bit-identical" + ended;
  const std::string digest = fmt::format("{:016x}", bone_digest);
  return "verified: " + figures + ", every force and the final bone (" + digest + ") bit-identical" + ended;
}

ReplayReport verify(const std::string& path) {
  try {
    return verifyReadable(path);
  } catch (const SessionError& refusal) {
    // Damage is a result; a file that is not a session, or a failing disk, is an error.
    if (refusal.kind != SessionErrorKind::damaged) throw;
    ReplayReport report;
    report.damage = refusal.what();
    return report;
  }
}

ReplayedState replayTo(SessionReader& session, double t_s) {
  session.rewind();
  StoredStart start = session.start();
  haptics::Bodies bodies(start.grid, start.solid, start.label, start.is_tooth);
  Rerun rerun(bodies, start.soft_tissue, session.commands());
  haptics::Tick last, last_recorded;
  std::optional<ReplayDifference> divergence;
  double recorded_mm3 = 0.0, again_mm3 = 0.0;
  for (TickBlock block = session.nextBlock(); !block.ticks.empty(); block = session.nextBlock()) {
    for (const haptics::Tick& recorded : block.ticks) {
      if (!(recorded.t_s < t_s)) break;
      auto what = rerun.prepare(recorded);
      last = rerun.step(recorded);
      if (!what) what = differenceOf(recorded, last);
      if (what && !divergence) divergence = ReplayDifference{recorded.index, *what};
      recorded_mm3 += recorded.removed_mm3, again_mm3 += last.removed_mm3;
      last_recorded = recorded;
    }
  }
  // The same digest means the same bone, even if a force differed in its last bit.
  if (divergence && last_recorded.bone_digest == bodies.digest()) divergence.reset();
  const haptics::Command command = rerun.command();
  return {std::move(start), std::move(bodies), last, command, divergence, again_mm3 - recorded_mm3};
}

BoneAtTime boneAtTime(const std::string& path, std::optional<double> t_s) {
  SessionReader session(path);
  refuseDamaged(session, path);
  BoneAtTime bone;
  double end_s = 0.0;
  for (TickBlock block = session.nextBlock(); !block.ticks.empty(); block = session.nextBlock())
    end_s = block.ticks.back().t_s + block.ticks.back().dt_s;
  if (!t_s || *t_s >= end_s) {
    if (const auto log = session.missingLog()) throw missingLogError(path, *log);
    bone.start = session.start();
    bone.t_s = end_s;
    if (auto left = session.finalBone(bone.start)) {
      bone.solid = std::move(left->solid);
      return bone;
    }
    bone.remarks.push_back(
        "the final bone is not in it, so it is recomputed by a replay, which needs the version that recorded it (" +
        bone.start.program_version + ")");
  }
  ReplayedState state = replayTo(session, t_s.value_or(std::numeric_limits<double>::infinity()));
  if (state.divergence) bone.remarks.push_back(divergenceText(state));
  bone.solid = state.bodies.solidInMouth();
  bone.t_s = state.tick.t_s + state.tick.dt_s;
  bone.start = std::move(state.start);
  return bone;
}

}  // namespace app
