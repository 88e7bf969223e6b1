// Any moment of a recorded session, within a second: the session is run again once, with a keyframe every second of it;
// a moment is the keyframe before it and the ticks from there on, bit for bit what a replay from the start gives. Frame
// P. One thread, not the servo; may be handed from one to another. index() takes the CPU time of the recorded steps;
// goTo() 20 to 50 ms for the keyframe and that of up to a second of steps; goNear() goes to the nearest keyframe alone.
// Memory: the bodies (4 bytes a voxel), 70 MB for the undo of the servo and its copy, 1 byte a voxel of the initial
// bone, 5 to 10 MB for each site that was made for a piece, one each time pieces came to rest beside an elevator or
// forceps: counted in bytes(), but not bounded, as keyframes lie on them; and what changed between keyframes: 256 bytes
// a block of 4x4x4 voxels and as much for its undo, at most Options::most_bytes. Where that is reached every second
// keyframe is dropped, and jumps take twice the time.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/session/field_clarity.h"
#include "app/session/page_versions.h"
#include "app/session/replay.h"
#include "app/session/rerun.h"
#include "app/session/session_reader.h"

namespace app {

class SessionMoments {
 public:
  struct Options {
    double between_keyframes_s = 1.0;
    std::size_t most_bytes = std::size_t{512} << 20;
  };
  /// Of an undamaged session, at its start. Throws SessionError; takes about a second.
  explicit SessionMoments(const std::string& path) : SessionMoments(path, Options{}) {}
  SessionMoments(const std::string& path, const Options& options);
  SessionMoments(const SessionMoments&) = delete;
  SessionMoments& operator=(const SessionMoments&) = delete;

  using Follow = std::function<void(const haptics::Tick&, const haptics::Command&)>;

  /// Runs on from where it ended, for about `most_s` of the session. False: the end was reached.
  bool index(double most_s, const Follow& follow = {});
  bool isIndexed() const { return indexed_; }
  double length_s() const { return length_s_; }

  /// After every tick that began before `t_s`, as replayTo(); no farther than indexed. `follow` gets the ticks that are
  /// run, the last ones at least.
  void goTo(double t_s, const Follow& follow = {});

  /// To the keyframe nearest to `t_s`, half of betweenKeyframes_s() away at most, all of it behind the last: some
  /// milliseconds, for a hand that scrubs. Where no keyframe was reached yet, nowhere else.
  void goNear(double t_s);

  haptics::Bodies& bodies() { return bodies_; }
  const haptics::Bodies& bodies() const { return bodies_; }
  const haptics::Tick& tick() const { return at_.tick; }  ///< the last one run; default before the first
  const haptics::Command& command() const { return rerun_.command(); }
  const FieldClarity& clarity() const { return at_.clarity; }
  const StoredStart& start() const { return start_; }
  /// Of all recorded commands and events, in order.
  const std::vector<SessionEvent>& events() const { return events_; }
  /// Bricks of the jaw's grid that have changed since the last call; may name one twice.
  std::vector<glm::ivec3> takeChangedBricks();

  /// The first difference from the recording, found by index().
  const std::optional<ReplayDifference>& difference() const { return difference_; }
  /// What was left, where it is at the end, as boneLeft().
  BoneLeft boneLeft();
  std::size_t keyframes() const { return keyframes_.size(); }
  double betweenKeyframes_s() const { return between_s_; }
  /// Of the keyframes alone; of all.
  std::size_t keyframeBytes() const;
  std::size_t bytes() const;

 private:
  struct Place {
    SessionReader::BlockPlace block;
    haptics::Tick tick;
    FieldClarity clarity;
    std::uint64_t ticks = 0;  ///< run until there
  };
  struct Keyframe {
    Place at;
    Rerun::State rerun;
    std::array<haptics::PiecePose, haptics::kMaxPieces> X_PQ;
  };
  void keepFirst();
  void keep();
  void halve();
  /// The keyframe before a moment, whose ticks all began before.
  std::size_t keyframeBefore(double t_s) const;
  void restore(std::size_t keyframe);
  /// The servo's undo, which is not looked at, is brought to restore()'s keyframe when ticks are run from there.
  void restoreUndo();
  haptics::BlockState keptState(std::size_t bone, std::size_t block, std::uint32_t version) const;
  void restoreBlock(std::size_t bone, std::size_t block, std::uint32_t version);
  /// Blocks since the last call.
  /// Of bone n, or of the filling behind the last.
  std::vector<std::size_t> written(std::size_t bone);
  haptics::BlockState stateNow(std::size_t bone, std::size_t block) const;
  /// Ticks of blocks, in order; false: the end.
  bool nextTick(haptics::Tick& recorded);
  void run(const haptics::Tick& recorded, const Follow& follow, bool compares);

  SessionReader session_;
  StoredStart start_;
  std::vector<SessionEvent> events_;
  haptics::Bodies bodies_;
  Rerun rerun_;
  double between_s_, length_s_ = 0.0;
  std::size_t most_bytes_;
  Place at_;
  TickBlock block_;
  std::size_t next_in_block_ = 0;
  std::optional<haptics::Tick> waiting_;  ///< read, and not to be run yet
  bool indexed_ = false;
  std::uint64_t indexed_ticks_ = 0;
  std::optional<ReplayDifference> difference_;
  std::uint64_t recorded_digest_ = 0;  ///< of the bone after the newest tick that index() ran

  std::vector<Keyframe> keyframes_;
  std::vector<std::uint8_t> first_solid_;              ///< of the jaw, slot by slot
  std::vector<std::uint32_t> first_slot_of_;           ///< by block; empty: every block's is its own number
  std::vector<PageVersions> blocks_;                   ///< BlockState by bone and block
  std::vector<std::vector<std::size_t>> kept_blocks_;  ///< by bone: those with a version
  std::vector<std::vector<bool>> is_kept_;
  ArrayVersions undo_{kUndoPage_bytes};
  std::optional<std::uint32_t> undo_wanted_;  ///< of this version, but is not yet

  static constexpr std::size_t kUndoPage_bytes = 512;
};

}  // namespace app
