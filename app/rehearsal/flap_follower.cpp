#include "app/rehearsal/flap_follower.h"

#include <utility>

#include <fmt/core.h>

#include "app/procedure/flap/flap_mesh.h"

namespace app {
namespace {

constexpr double kBetweenFlapEvents_s = 1.0;

}  // namespace

FlapFollower::FlapFollower(const RehearsalPlan& plan, EventLog& event_log)
    : plan_(plan),
      event_log_(event_log),
      flap_(plan.patient, plan.patient.gingiva, plan.cut.value(), plan.soft_tissue, plan.gravity_P()) {
  event_log_.note("flap planned", fmt::format("incision {:.1f} mm", flap_.plan().incisionLength_mm()));
}

void FlapFollower::follow(std::span<const haptics::Tick> ticks, const haptics::Command& command, std::uint64_t serial) {
  if (commands_.empty() || commands_.back().first != serial) commands_.emplace_back(serial, command);
  for (const haptics::Tick& tick : ticks) {
    while (commands_.size() > 1 && commands_[1].first <= tick.command_serial) commands_.pop_front();
    flap_.follow(tick, commands_.front().second);
    now_s_ = tick.t_s + tick.dt_s;
  }
  while (auto line = flap_.news()) {
    event_log_.note("flap told", *line);
    news_.push_back(std::move(*line));
  }
  tell(false);
}

void FlapFollower::tell(bool is_last) {
  if (!is_last && now_s_ - told_s_ < kBetweenFlapEvents_s) return;
  told_s_ = now_s_;
  FlapRecord now = flap_.record();
  // A sheet that sinks is no news by itself.
  const std::uint64_t digest = now.digest;
  if (!is_last) now.digest = told_.digest;
  if (!is_last && now == told_) return;
  now.digest = digest;
  told_ = now;
  event_log_.note(kFlapEvent, flapText(told_));
}

void FlapFollower::show(render::Frame& frame) {
  if (flap_.sheet() && drawn_number_ != flap_.sheetNumber()) {
    drawn_number_ = flap_.sheetNumber();
    gum_ = gumAround(plan_.patient.gingiva, flap_.chart(), *flap_.sheet());
  }
  if (drawn_sheet_ != flap_.sheetRevision() || drawn_incision_ != flap_.incisionRevision()) {
    drawn_sheet_ = flap_.sheetRevision(), drawn_incision_ = flap_.incisionRevision();
    sheet_ = flapMesh(flap_);
    ++flap_serial_;
  }
  frame.flap = sheet_.parts.empty() ? nullptr : &sheet_;
  frame.gum = drawn_number_ > 0 ? &gum_ : nullptr;
  frame.flap_serial = flap_serial_, frame.gum_serial = drawn_number_;
}

std::optional<std::string> FlapFollower::news() {
  if (news_.empty()) return {};
  std::string line = std::move(news_.front());
  news_.pop_front();
  return line;
}

}  // namespace app
