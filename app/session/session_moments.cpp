#include "app/session/session_moments.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "app/session/session_error.h"

namespace app {
namespace {

std::span<const std::byte> bytesOf(const haptics::BlockState& state) { return std::as_bytes(std::span(&state, 1)); }

haptics::BlockState stateFrom(std::span<const std::byte> content) {
  haptics::BlockState state;
  std::ranges::copy(content, std::as_writable_bytes(std::span(&state, 1)).begin());
  return state;
}

StoredStart checkedStart(SessionReader& session, const std::string& path) {
  refuseDamaged(session, path);
  if (const auto log = session.missingLog()) throw missingLogError(path, *log);
  return session.start();
}

}  // namespace

SessionMoments::SessionMoments(const std::string& path, const Options& options)
    : session_(path),
      start_(checkedStart(session_, path)),
      events_(session_.events()),
      bodies_(bodiesAtStart(start_)),
      rerun_(bodies_, start_.soft_tissue, session_.commands(), Rerun::Keeping::all),
      between_s_(options.between_keyframes_s),
      length_s_(session_.length_s()),
      most_bytes_(options.most_bytes) {
  if (start_.setup.site) at_.clarity = FieldClarity({start_.setup.site->centre_P_mm});
  session_.rewind();
  at_.block = session_.place();
  keepFirst();
}

/// Version 0 of what is not in the jaw's initial bytes: pieces without anything in them have doses, too.
void SessionMoments::keepFirst() {
  const std::span<haptics::CarvedBone> bones = bodies_.bones();
  const haptics::CarvedBone& jaw = bones.front();
  const haptics::SolidField first = jaw.field();
  first_solid_.assign(first.solid, first.solid + jaw.slots() * haptics::kBlockVoxels);
  if (first.slot_of != nullptr) first_slot_of_.assign(first.slot_of, first.slot_of + jaw.blocks());
  for (std::size_t bone = 0; bone < bones.size(); ++bone) {
    blocks_.emplace_back(sizeof(haptics::BlockState), bones[bone].blocks());
    is_kept_.emplace_back(bones[bone].blocks());
  }
  if (const haptics::Filling* const filling = bodies_.filling()) {
    blocks_.emplace_back(sizeof(haptics::BlockState), filling->blocks());
    is_kept_.emplace_back(filling->blocks());
  }
  kept_blocks_.resize(blocks_.size());
  for (std::size_t bone = 1; bone < bones.size(); ++bone) {
    written(bone);  // when it was made
    for (std::size_t block = 0; block < bones[bone].blocks(); ++block) {
      const haptics::BlockState state = bones[bone].stateOf(block);
      if (!(state == haptics::BlockState{})) blocks_[bone].put(block, 0, bytesOf(state));
    }
  }
  keep();
}

std::vector<std::size_t> SessionMoments::written(std::size_t bone) {
  std::vector<std::size_t> blocks;
  if (bone < bodies_.bones().size())
    bodies_.bones()[bone].takeWritten(blocks);
  else
    bodies_.filling()->takeWritten(blocks);
  return blocks;
}

haptics::BlockState SessionMoments::stateNow(std::size_t bone, std::size_t block) const {
  return bone < bodies_.bones().size() ? bodies_.bones()[bone].stateOf(block) : bodies_.filling()->stateOf(block);
}

void SessionMoments::keep() {
  const auto version = static_cast<std::uint32_t>(keyframes_.size());
  for (std::size_t bone = 0; bone < blocks_.size(); ++bone)
    for (const std::size_t block : written(bone)) {
      const haptics::BlockState state = stateNow(bone, block);
      if (keptState(bone, block, version) == state) continue;
      if (!is_kept_[bone][block]) kept_blocks_[bone].push_back(block);
      is_kept_[bone][block] = true;
      blocks_[bone].put(block, version, bytesOf(state));
    }
  rerun_.withMemory([&](ArrayVersions::Arrays arrays) { undo_.keep(arrays, version); });
  Keyframe one{at_, rerun_.state(), {}};
  for (std::size_t piece = 0; piece < haptics::kMaxPieces; ++piece) one.X_PQ[piece] = bodies_.pose(piece);
  keyframes_.push_back(std::move(one));
  if (keyframes_.size() % 2 == 1 && keyframes_.size() > 2 && keyframeBytes() > most_bytes_) halve();
}

void SessionMoments::halve() {
  for (PageVersions& bone : blocks_) bone.halve();
  undo_.halve();
  std::vector<Keyframe> left;
  for (std::size_t n = 0; n < keyframes_.size(); n += 2) left.push_back(std::move(keyframes_[n]));
  keyframes_ = std::move(left);
  between_s_ *= 2.0;
}

haptics::BlockState SessionMoments::keptState(std::size_t bone, std::size_t block, std::uint32_t version) const {
  haptics::BlockState state;
  const std::span<const std::byte> kept = blocks_[bone].at(block, version);
  if (!kept.empty())
    state = stateFrom(kept);
  else if (bone == 0) {
    const std::size_t slot = first_slot_of_.empty() ? block : first_slot_of_[block];
    std::copy_n(first_solid_.begin() + static_cast<std::ptrdiff_t>(slot * haptics::kBlockVoxels), haptics::kBlockVoxels,
                state.solid.begin());
  }
  return state;
}

void SessionMoments::restoreBlock(std::size_t bone, std::size_t block, std::uint32_t version) {
  const haptics::BlockState state = keptState(bone, block, version);
  if (stateNow(bone, block) == state) return;
  if (bone < bodies_.bones().size())
    bodies_.bones()[bone].restoreBlock(block, state);
  else
    bodies_.filling()->restoreBlock(block, state);
}

void SessionMoments::restore(std::size_t number) {
  const auto version = static_cast<std::uint32_t>(number);
  for (std::size_t bone = 0; bone < blocks_.size(); ++bone) {
    for (const std::size_t block : written(bone)) restoreBlock(bone, block, version);
    for (const std::size_t block : kept_blocks_[bone]) restoreBlock(bone, block, version);
    written(bone);  // by this: as kept
  }
  const Keyframe& one = keyframes_[number];
  for (std::size_t piece = 0; piece + 1 < bodies_.bones().size(); ++piece) bodies_.putBack(piece, one.X_PQ[piece]);
  rerun_.restore(one.rerun);
  undo_wanted_ = version;
  at_ = one.at;
  session_.continueAt(at_.block);
  block_ = {};
  next_in_block_ = 0;
  waiting_.reset();
}

void SessionMoments::restoreUndo() {
  if (!undo_wanted_) return;
  const std::uint32_t version = *std::exchange(undo_wanted_, std::nullopt);
  rerun_.withMemory([&](ArrayVersions::Arrays arrays) { undo_.restore(arrays, version); });
}

bool SessionMoments::nextTick(haptics::Tick& recorded) {
  if (waiting_) {
    recorded = *std::exchange(waiting_, std::nullopt);
    return true;
  }
  if (next_in_block_ == block_.ticks.size()) {
    block_ = session_.nextBlock();
    next_in_block_ = 0;
    if (block_.ticks.empty()) return false;
  }
  recorded = block_.ticks[next_in_block_++];
  return true;
}

void SessionMoments::run(const haptics::Tick& recorded, const Follow& follow, bool compares) {
  restoreUndo();
  auto what = rerun_.prepare(recorded);
  at_.tick = rerun_.step(recorded);
  ++at_.ticks;
  if (compares) recorded_digest_ = recorded.bone_digest;
  if (compares && !difference_) {
    if (!what) what = differenceOf(recorded, at_.tick);
    if (what) difference_ = ReplayDifference{recorded.index, *what};
  }
  at_.clarity.step(at_.tick, rerun_.command().irrigating);
  if (follow) follow(at_.tick, rerun_.command());
}

bool SessionMoments::index(double most_s, const Follow& follow) {
  if (indexed_) return false;
  if (at_.ticks != indexed_ticks_) goTo(std::numeric_limits<double>::infinity());
  const double until_s = at_.tick.t_s + most_s;
  haptics::Tick recorded;
  while (at_.tick.t_s < until_s) {
    // A keyframe lies between two blocks.
    if (next_in_block_ == block_.ticks.size()) {
      at_.block = session_.place();
      const double now_s = at_.tick.t_s + at_.tick.dt_s;
      if (at_.ticks > keyframes_.back().at.ticks && now_s >= static_cast<double>(keyframes_.size()) * between_s_)
        keep();
    }
    if (!nextTick(recorded)) {
      indexed_ = true;
      length_s_ = at_.tick.t_s + at_.tick.dt_s;
      break;
    }
    run(recorded, follow, true);
  }
  indexed_ticks_ = at_.ticks;
  return !indexed_;
}

std::size_t SessionMoments::keyframeBefore(double t_s) const {
  const auto after = std::ranges::upper_bound(
      keyframes_, t_s, [](double t, double of) { return t <= of; },
      [](const Keyframe& one) { return one.at.ticks == 0 ? -1.0 : one.at.tick.t_s; });
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(1, after - keyframes_.begin()) - 1);
}

void SessionMoments::goNear(double t_s) {
  std::size_t number = keyframeBefore(t_s);
  if (number + 1 < keyframes_.size() && keyframes_[number + 1].at.tick.t_s - t_s < t_s - keyframes_[number].at.tick.t_s)
    ++number;
  if (at_.ticks != keyframes_[number].at.ticks) restore(number);
}

void SessionMoments::goTo(double t_s, const Follow& follow) {
  const std::size_t number = keyframeBefore(t_s);
  const bool is_behind = at_.ticks > 0 && !(at_.tick.t_s < t_s);
  if (is_behind || keyframes_[number].at.ticks > at_.ticks) restore(number);
  haptics::Tick recorded;
  while (at_.ticks < indexed_ticks_ && nextTick(recorded)) {
    if (!(recorded.t_s < t_s)) {
      waiting_ = recorded;
      return;
    }
    run(recorded, follow, false);
  }
}

std::vector<glm::ivec3> SessionMoments::takeChangedBricks() { return rerun_.takeChanged(); }

BoneLeft SessionMoments::boneLeft() {
  BoneLeft left;
  if (auto recorded = session_.finalBone(start_)) {
    left.solid = std::move(recorded->solid);
    left.laid = session_.finalFilling(start_);
    return left;
  }
  left.solid = bodies_.solidInMouth();
  left.laid = laidIn(bodies_);
  left.removed_mm3 = removedByKey(bodies_.removedByTissue_mm3());
  if (recorded_digest_ != bodies_.digest()) left.divergence = difference_;
  return left;
}

std::size_t SessionMoments::keyframeBytes() const {
  std::size_t all = undo_.bytes() + keyframes_.capacity() * sizeof(Keyframe);
  for (const PageVersions& bone : blocks_) all += bone.bytes();
  for (const Keyframe& one : keyframes_)
    for (const auto& piece : one.rerun.pieces)
      if (piece) all += 4 * sizeof(float) * piece->ligament.torn.size();
  return all;
}

std::size_t SessionMoments::bytes() const {
  std::size_t all = keyframeBytes() + first_solid_.size() + rerun_.siteBytes();
  for (const haptics::CarvedBone& bone : bodies_.bones()) all += bone.bytes();
  return all;
}

}  // namespace app
