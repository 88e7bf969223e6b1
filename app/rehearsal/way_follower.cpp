#include "app/rehearsal/way_follower.h"

namespace app {
namespace {

std::string whyNoWays(const RehearsalPlan& plan, const haptics::Bodies& bodies) {
  if (bodies.pieces() == 0 || !plan.patient.site) return "no tooth is operated here";
  if (plan.is_assessed || (plan.procedure_steps && plan.procedure_steps->guidance == Guidance::assessed))
    return "what keeps the tooth in is not told in an assessed rehearsal";
  return "";
}

}  // namespace

WayFollower::WayFollower(const RehearsalPlan& plan, const haptics::Bodies& bodies, EventLog& event_log)
    : event_log_(event_log), why_not_(whyNoWays(plan, bodies)) {
  if (why_not_.empty()) watch_.emplace(plan.patient, bodies);
}

void WayFollower::ask() {
  if (watch_)
    watch_->ask();
  else
    news_ = why_not_;
}

void WayFollower::follow(std::span<const glm::ivec3> bricks, const haptics::Tick& newest, bool alone, bool waits) {
  if (!watch_) return;
  watch_->follow(bricks, newest, alone, waits);
  if (const auto found = watch_->takeNews()) event_log_.note(kWayEvent, wayText(*found));
}

std::string WayFollower::words() const { return watch_ && watch_->newest() ? wayInWords(*watch_->newest()) : ""; }

std::string WayFollower::line() const {
  return watch_ && watch_->isLooking() ? "looking for what keeps the tooth in …" : words();
}

render::Obstacles WayFollower::obstacles() const {
  render::Obstacles obstacles;
  if (!watch_) return obstacles;
  obstacles.voxel_mm = watch_->voxel_mm();
  obstacles.middle_P_mm.assign(watch_->bone_P_mm().begin(), watch_->bone_P_mm().end());
  return obstacles;
}

}  // namespace app
