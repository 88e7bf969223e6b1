#include "app/procedure/way_watch.h"

#include <algorithm>
#include <map>

#include "assets/ct_volume.h"

namespace app {
namespace {

constexpr double kAfterChange_s = 1.0;

/// Bytes move between bodies, or a piece is in the hand.
bool isBusy(const haptics::Tick& tick) {
  return tick.split == haptics::SplitAnswer::waiting || tick.split == haptics::SplitAnswer::running ||
         tick.bridge == haptics::BreakAnswer::breaking || tick.gripped != 0 || tick.lever.piece != 0 ||
         tick.drill_inhibit == haptics::DrillInhibit::undo_running;
}

std::size_t outOfMouth(const haptics::Tick& tick) {
  std::size_t out = 0;
  for (std::size_t n = 0; n < tick.pieces; ++n) out += haptics::Bodies::isAside(tick.X_PQ[n]) ? 1 : 0;
  return out;
}

}  // namespace

WayWatch::WayWatch(const assets::Patient& patient, const haptics::Bodies& bodies)
    : bodies_(bodies),
      search_(patient, bodies),
      is_changed_(assets::VolumeGrid{bodies.grid().bricks(), 1.0, {}}.voxelCount(), 0),
      jaw_(bodies.jaw().copyBox(glm::ivec3(0), bodies.grid().size)),
      thread_([this] { run(); }) {}

WayWatch::~WayWatch() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
    stop_.request_stop();
  }
  wake_.notify_all();
  thread_.join();
}

void WayWatch::ask() { wants_now_ = wants_whole_ = true; }

void WayWatch::stopSearch() {
  const std::lock_guard lock(mutex_);
  stop_.request_stop();
  question_.reset();
  answer_.reset();
  looking_.reset();
}

/// What is known is not asked again.
bool WayWatch::isDue(const haptics::Tick& newest, bool alone) const {
  if (isBusy(newest) || looking_) return false;
  if (wants_now_) return true;
  const bool is_of_interest = wants_whole_ || newest.pieces > 1 || outOfMouth(newest) > 0;
  return alone && is_of_interest && answered_ != newest.bone_digest && newest.t_s - changed_s_ >= kAfterChange_s;
}

void WayWatch::begin(const haptics::Tick& newest) {
  Question question{newest.bone_digest, std::exchange(wants_now_, false), newest.pieces, copyOfPieces(bodies_, newest)};
  std::vector<Brick> bricks;
  for (const glm::ivec3& at : std::exchange(changed_, {})) {
    is_changed_[assets::indexIn(bodies_.grid().bricks(), at)] = 0;
    bricks.push_back({at, {}});
    bodies_.jaw().copyBrick(at, bricks.back().solid);
  }
  looking_ = question.digest;
  {
    const std::lock_guard lock(mutex_);
    stop_.request_stop();
    answer_.reset();
    bricks_.insert(bricks_.end(), bricks.begin(), bricks.end());
    question_ = std::move(question);
  }
  wake_.notify_all();
}

void WayWatch::takeAnswer(const haptics::Tick& newest) {
  std::optional<Answer> answer;
  {
    const std::lock_guard lock(mutex_);
    answer = std::exchange(answer_, std::nullopt);
  }
  if (!answer || answer->digest != newest.bone_digest) return;
  looking_.reset();
  answered_ = answer->digest;
  told_.reset();
  if (!answer->found.record.pieces.empty()) told_ = news_ = std::move(answer->found.record);
  bone_P_mm_ = std::move(answer->found.bone_P_mm);
  voxel_mm_ = answer->found.voxel_mm;
}

/// What is gone is no longer shown.
void WayWatch::leaveOutCut(std::span<const glm::ivec3> bricks) {
  if (bone_P_mm_.empty() || bricks.empty()) return;
  const assets::VolumeGrid& grid = bodies_.grid();
  std::map<std::size_t, std::array<std::uint8_t, 512>> now;
  for (const glm::ivec3& brick : bricks) bodies_.jaw().copyBrick(brick, now[assets::indexIn(grid.bricks(), brick)]);
  std::erase_if(bone_P_mm_, [&](const glm::dvec3& p_mm) {
    const glm::ivec3 ijk(glm::round(grid.indexFromPoint(p_mm)));
    const auto found = now.find(assets::indexIn(grid.bricks(), ijk / assets::kBrickVoxels));
    if (found == now.end()) return false;
    const glm::ivec3 in_brick = ijk % assets::kBrickVoxels;
    return found->second[assets::indexIn(glm::ivec3(assets::kBrickVoxels), in_brick)] < assets::kHalfSolid;
  });
}

void WayWatch::forget() {
  told_.reset();
  bone_P_mm_.clear();
  wants_now_ = false;
}

void WayWatch::follow(std::span<const glm::ivec3> bricks, const haptics::Tick& newest, bool alone, bool waits) {
  for (const glm::ivec3& brick : bricks)
    if (std::exchange(is_changed_[assets::indexIn(bodies_.grid().bricks(), brick)], 1) == 0) changed_.push_back(brick);
  leaveOutCut(bricks);
  if (newest.dt_s == 0.0) return;
  if (std::exchange(last_digest_, newest.bone_digest) != newest.bone_digest) changed_s_ = newest.t_s;
  if (looking_ && *looking_ != newest.bone_digest) stopSearch();
  if (newest.pieces == 0 || outOfMouth(newest) == newest.pieces) return forget();
  takeAnswer(newest);
  if (!isDue(newest, alone)) return;
  begin(newest);
  if (!waits) return;
  {
    std::unique_lock lock(mutex_);
    done_.wait(lock, [this] { return answer_.has_value(); });
  }
  takeAnswer(newest);
}

void WayWatch::run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    wake_.wait(lock, [this] { return ending_ || question_; });
    if (ending_) return;
    Question question = std::move(*std::exchange(question_, std::nullopt));
    const std::vector<Brick> bricks = std::exchange(bricks_, {});
    stop_ = std::stop_source();
    const std::stop_token stop = stop_.get_token();
    lock.unlock();

    const assets::VolumeGrid& grid = bodies_.grid();
    for (const Brick& brick : bricks) {
      std::size_t n = 0;
      assets::forVoxels(glm::ivec3(0), glm::ivec3(assets::kBrickVoxels), [&](glm::ivec3 at) {
        const glm::ivec3 ijk = assets::kBrickVoxels * brick.at + at;
        if (grid.contains(ijk)) jaw_[grid.index(ijk)] = brick.solid[n];
        ++n;
      });
    }
    question.bodies.jaw = std::move(jaw_);
    WayFindings found = search_.find(question.bodies, question.pieces, stop);
    jaw_ = std::move(question.bodies.jaw);
    found.record.was_asked = question.was_asked;

    lock.lock();
    if (!stop.stop_requested()) answer_ = Answer{question.digest, std::move(found)};
    done_.notify_all();
  }
}

}  // namespace app
