#include "app/rehearsal/clearance_watch.h"

#include <algorithm>

#include "app/session/measures/rests_on.h"

namespace app {

void ClearanceWatch::follow(std::span<const haptics::Tick> ticks, const haptics::Command& command,
                            std::uint64_t serial) {
  if (!(command.tool == tool_)) {
    former_ = std::exchange(tool_, command.tool);
    serial_ = serial;
  }
  for (const haptics::Tick& tick : ticks) measures_.add(tick, tick.command_serial < serial_ ? former_ : tool_);
}

void ClearanceWatch::update(const haptics::Tick& newest, const haptics::Tool& tool) {
  const bool is_told = newest.dt_s > 0.0 && !tool.grips && !has(newest.faults, haptics::Fault::bad_pose);
  now_ = is_told ? haptics::clearances_mm(risks_, tool, heldPose(newest)) : haptics::Clearances{};
}

std::vector<HeadUpClearance> ClearanceWatch::ruler(const assets::Proposed& proposed) const {
  std::vector<HeadUpClearance> near;
  for (std::size_t n = 0; n < now_.size(); ++n) {
    if (!now_[n]) continue;
    const assets::RiskLevel level = assets::riskLevel(n, *now_[n]);
    if (level == assets::RiskLevel::none) continue;
    near.push_back({std::string(assets::kRiskTexts[n].name), *now_[n], level,
                    isConfirmed(static_cast<assets::RiskStructure>(n), proposed)});
  }
  std::ranges::stable_sort(near, std::greater{}, &HeadUpClearance::level);
  return near;
}

}  // namespace app
