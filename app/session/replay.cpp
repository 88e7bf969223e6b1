#include "app/session/replay.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/core.h>

#include "app/session/fragments_event.h"
#include "app/session/increment_trail.h"
#include "app/session/rerun.h"
#include "app/session/session_error.h"
#include "app/text/version.h"

namespace app {
namespace {

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
  haptics::Bodies bodies = bodiesAtStart(start);
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

std::string replayedText(const StoredStart& start) {
  return "the final bone is not in it, so it is recomputed by a replay, which needs the version that recorded it (" +
         start.program_version + ")";
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
  haptics::Bodies bodies = bodiesAtStart(start);
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

std::optional<haptics::Filling::Volumes> laidIn(const haptics::Bodies& bodies) {
  const haptics::Filling* const filling = bodies.filling();
  return filling != nullptr && !filling->isEmpty() ? std::optional(filling->volumes()) : std::nullopt;
}

BoneLeft boneLeft(SessionReader& session, const StoredStart& start) {
  BoneLeft left;
  if (auto recorded = session.finalBone(start)) {
    left.solid = std::move(recorded->solid);
    left.laid = session.finalFilling(start);
    return left;
  }
  const ReplayedState state = replayTo(session, std::numeric_limits<double>::infinity());
  session.rewind();
  left.solid = state.bodies.solidInMouth();
  left.laid = laidIn(state.bodies);
  left.removed_mm3 = removedByKey(state.bodies.removedByTissue_mm3());
  left.divergence = state.divergence;
  left.remarks.push_back(replayedText(start));
  if (state.divergence) left.remarks.push_back(divergenceText(state));
  return left;
}

std::vector<std::uint8_t> withLaid(std::vector<std::uint8_t> solid,
                                   const std::optional<haptics::Filling::Volumes>& laid) {
  if (!laid) return solid;
  for (std::size_t v = 0; v < solid.size(); ++v)
    solid[v] = static_cast<std::uint8_t>(std::min(255, solid[v] + laid->laid[v]));
  return solid;
}

std::vector<std::uint8_t> labelsWithLaid(const BoneAtTime& bone) {
  std::vector<std::uint8_t> label = bone.start.label;
  if (!bone.laid) return label;
  for (std::size_t v = 0; v < label.size(); ++v)
    if (bone.laid->laid[v] > 0 && bone.laid->laid[v] >= bone.solid[v]) label[v] = bone.laid->tissue[v];
  return label;
}

BoneAtTime boneAtTime(const std::string& path, std::optional<double> t_s) {
  SessionReader session(path);
  refuseDamaged(session, path);
  BoneAtTime bone;
  double end_s = 0.0;
  bone.start = session.start();
  IncrementTrail increments(bone.start.laid ? bone.start.laid->age_s : std::vector<double>());
  for (TickBlock block = session.nextBlock(); !block.ticks.empty(); block = session.nextBlock()) {
    for (const haptics::Tick& tick : block.ticks) increments.follow(tick);
    end_s = block.ticks.back().t_s + block.ticks.back().dt_s;
  }
  if (!t_s || *t_s >= end_s) {
    if (const auto log = session.missingLog()) throw missingLogError(path, *log);
    bone.t_s = end_s;
    BoneLeft left = boneLeft(session, bone.start);
    bone.solid = std::move(left.solid);
    bone.laid = std::move(left.laid);
    if (bone.laid) bone.laid->age_s = increments.ages_s(end_s);
    bone.fragments = fragmentsIn(bone.start.setup, session.events());
    bone.remarks = std::move(left.remarks);
    return bone;
  }
  ReplayedState state = replayTo(session, *t_s);
  if (state.divergence) bone.remarks.push_back(divergenceText(state));
  bone.solid = state.bodies.solidInMouth();
  bone.laid = laidIn(state.bodies);
  bone.t_s = state.tick.t_s + state.tick.dt_s;
  bone.fragments = fragmentsIn(state.start.setup, session.events(), state.tick.index);
  bone.start = std::move(state.start);
  return bone;
}

}  // namespace app
