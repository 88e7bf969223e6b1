#include "app/procedure/teeth_watch.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "haptics/body/bridge_break.h"
#include "haptics/body/bridge_strength.h"
#include "haptics/body/piece_split.h"

namespace app {
namespace {

constexpr std::chrono::milliseconds kBetweenLooks{50};
constexpr int kLooksPerBridge = 4;

}  // namespace

TeethWatch::TeethWatch(const assets::VolumeGrid& grid, std::span<const std::uint8_t> solid,
                       std::vector<std::uint8_t> label)
    : survey_(grid, solid), label_(std::move(label)), bricks_(grid.bricks()), thread_([this] { run(); }) {}

TeethWatch::~TeethWatch() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void TeethWatch::give(glm::ivec3 brick, const Brick& solid) {
  {
    const std::lock_guard lock(mutex_);
    given_.insert_or_assign(assets::indexIn(bricks_, brick), std::pair{brick, solid});
    confirmed_.reset();
    parting_.reset();
    break_.reset();
    ++content_;
  }
  wake_.notify_all();
}

void TeethWatch::confirm(std::uint64_t digest) {
  {
    const std::lock_guard lock(mutex_);
    confirmed_ = digest;
  }
  wake_.notify_all();
}

std::unique_ptr<TeethWatch::Parting> TeethWatch::takeParting() {
  const std::lock_guard lock(mutex_);
  return std::move(parting_);
}

void TeethWatch::planBreaks(bool wanted) {
  {
    const std::lock_guard lock(mutex_);
    if (std::exchange(plans_breaks_, wanted) == wanted) return;
  }
  wake_.notify_all();
}

std::unique_ptr<haptics::BreakPlan> TeethWatch::takeBreak() {
  const std::lock_guard lock(mutex_);
  return std::move(break_);
}

void TeethWatch::settle() {
  std::unique_lock lock(mutex_);
  hurry_ = true;
  wake_.notify_all();
  settled_.wait(lock, [this] { return given_.empty() && !is_looking_ && !owes_bridges_ && !mayPart() && !mayBreak(); });
  hurry_ = false;
}

/// Nothing new, and it is sure what it is: whether it has fallen apart.
void TeethWatch::lookForParting(std::unique_lock<std::mutex>& lock) {
  const std::uint64_t digest = *confirmed_;
  lock.unlock();
  haptics::SplitPlan plan = haptics::partingPlan(survey_.components());
  lock.lock();
  parted_ = digest;
  if (!plan.blocks.empty() && confirmed_ == digest)
    parting_ = std::make_unique<Parting>(Parting{std::move(plan), digest});
}

/// And which bridge breaks first.
void TeethWatch::lookForBreak(std::unique_lock<std::mutex>& lock) {
  const std::uint64_t content = content_;
  lock.unlock();
  std::optional<haptics::BreakPlan> weakest;
  double least_N = 0.0;
  const haptics::Components& components = survey_.components();
  if (haptics::ToothFindings found = survey_.pieces(); found.pieces == 1) {
    survey_.findBridges(found, components.grid().spacing_mm);
    const haptics::ToothFindings::Held& held = found.held[0];
    for (std::size_t n = 0; held.parts > 1 && n < std::min(held.bridges, held.bridge.size()); ++n) {
      auto plan = haptics::breakPlan(components, label_, held.bridge[n]);
      if (!plan) continue;
      const double force_N = haptics::breakingForce_N(plan->bridge, plan->enamel_share);
      if (weakest && force_N >= least_N) continue;
      weakest = std::move(plan);
      least_N = force_N;
    }
  }
  lock.lock();
  break_of_ = content;
  if (weakest && content == content_) break_ = std::make_unique<haptics::BreakPlan>(std::move(*weakest));
}

void TeethWatch::run() {
  Report report;
  int looks_without = 0;
  std::unique_lock lock(mutex_);
  for (;;) {
    wake_.wait(lock, [this] { return stopping_ || !given_.empty() || owes_bridges_ || mayPart() || mayBreak(); });
    if (stopping_) return;
    if (given_.empty() && !owes_bridges_) {
      is_looking_ = true;
      mayPart() ? lookForParting(lock) : lookForBreak(lock);
      is_looking_ = false;
      settled_.notify_all();
      continue;
    }
    const auto bricks = std::exchange(given_, {});
    is_looking_ = true;
    lock.unlock();

    for (const auto& [number, brick] : bricks) survey_.update(brick.first, brick.second);
    report.findings = survey_.pieces();
    report.has_bridges = false;
    ++report.serial;
    lock.lock();
    const bool with_bridges = given_.empty() || ++looks_without >= kLooksPerBridge;
    lock.unlock();
    if (with_bridges) {
      survey_.findBridges(report.findings, haptics::kBridgeCell_mm);
      report.has_bridges = true;
      looks_without = 0;
    }
    newest_.publish(report);

    lock.lock();
    is_looking_ = false;
    owes_bridges_ = !with_bridges;
    settled_.notify_all();
    wake_.wait_for(lock, kBetweenLooks, [this] { return stopping_ || hurry_; });
  }
}

}  // namespace app
