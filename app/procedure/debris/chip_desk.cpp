#include "app/procedure/debris/chip_desk.h"

#include <chrono>
#include <utility>

namespace app {

ChipDesk::ChipDesk(const haptics::Bodies& bodies)
    : bodies_(bodies), first_(std::make_unique<haptics::FirstBytes>(bodies)) {}

ChipDesk::~ChipDesk() {
  if (job_) job_->plan.wait();
}

/// With the bytes of now: the thread sees none of the bodies.
void ChipDesk::begin(const haptics::Tick& newest) {
  std::vector<Brick> bricks;
  for (const glm::ivec3& brick : std::exchange(changed_, {})) {
    bricks.push_back({0, brick, {}});
    bodies_.jaw().copyBrick(brick, bricks.back().solid);
    const auto own = bodies_.brickOfPiece(brick);
    for (std::size_t bone = 1; own && bone < bodies_.bones().size(); ++bone) {
      bricks.push_back({bone, *own, {}});
      bodies_.bones()[bone].copyBrick(*own, bricks.back().solid);
    }
  }
  looked_at_ = newest.bone_digest;
  looks_again_ = false;
  job_.emplace(Job{newest.bone_digest, std::async(std::launch::async, [this, bricks = std::move(bricks)] {
                     if (!search_) search_ = std::make_unique<haptics::ChipSearch>(*std::exchange(first_, nullptr));
                     for (const Brick& brick : bricks) search_->update(brick.bone, brick.at, brick.solid);
                     return search_->plan();
                   })});
}

std::optional<haptics::ChipOrder> ChipDesk::follow(std::span<const glm::ivec3> bricks, const haptics::Tick& newest,
                                                   bool is_applied, bool waits) {
  changed_.insert(changed_.end(), bricks.begin(), bricks.end());
  if (newest.dt_s == 0.0 || !is_applied) return {};
  if (asked_) {
    const haptics::ChipAnswer answer = newest.chips;
    if (answer == haptics::ChipAnswer::waiting || answer == haptics::ChipAnswer::running) return {};
    asked_ = false;
    if (answer == haptics::ChipAnswer::done)
      loosened_ = &plans_.back();
    else
      looks_again_ = true;
  }
  const bool is_quiet = std::exchange(last_digest_, newest.bone_digest) == newest.bone_digest && bricks.empty();
  const bool is_busy = newest.split == haptics::SplitAnswer::waiting || newest.split == haptics::SplitAnswer::running ||
                       newest.bridge == haptics::BreakAnswer::breaking || newest.gripped != 0 ||
                       newest.lever.piece != 0 || newest.drill_inhibit == haptics::DrillInhibit::undo_running;
  if (!is_quiet || is_busy) return {};
  const bool is_new = looked_at_ != newest.bone_digest && !changed_.empty();
  if (!job_ && (is_new || looks_again_)) begin(newest);
  if (!job_ || (!waits && job_->plan.wait_for(std::chrono::seconds(0)) != std::future_status::ready)) return {};
  Job job = std::move(*job_);
  job_.reset();
  haptics::ChipPlan plan = job.plan.get();
  looks_again_ = job.digest != newest.bone_digest;
  if (plan.chips.empty() || looks_again_) return {};
  asked_ = true;
  const haptics::ChipPlan& kept = plans_.emplace_back(std::move(plan));
  return haptics::ChipOrder{0, job.digest, kept.digest, &kept};
}

const haptics::ChipPlan* ChipDesk::takeLoosened() { return std::exchange(loosened_, nullptr); }

}  // namespace app
