#include "app/rehearsal/equipment.h"

#include <utility>

namespace app {

Equipment::Equipment(RehearsalPlan& plan)
    : source_(plan.hand_script ? handAlong(*std::move(plan.hand_script), "scripted hand, preparation")
                               : openPoseSource(plan.device, plan.device_options, plan.patient, plan.rig, plan.cut,
                                                std::move(plan.opened))),
      rate_Hz_(plan.rate_Hz.value_or(source_.rate_Hz.value_or(1000.0))),
      damping_Ns_per_mm_(source_.device->capabilities().damping_Ns_per_mm),
      has_motors_(source_.device->capabilities().has_motors) {
  if (!plan.second_hand.device.empty())
    second_hand_.emplace(plan.second_hand, plan.device_options, plan.patient, plan.rig, plan.ticking);
  if (plan.pedal) pedal_.emplace(*plan.pedal);
}

void Equipment::connect(const RehearsalPlan& plan, const haptics::Command& in_force) {
  workstation_.emplace(plan.patient, std::move(source_.device),
                       haptics::LoopSettings{.rate_Hz = rate_Hz_,
                                             .X_PD = source_.X_PD,
                                             .X_HT = source_.X_HT,
                                             .held_by_end = source_.held_by_end,
                                             .arm = source_.arm,
                                             .priority = plan.device_options.servo_priority,
                                             .buttons = {},
                                             .pedal = pedal_ ? &*pedal_ : nullptr},
                       in_force, plan.recording, plan.ticking, true,
                       plan.shows_whole_operation ? assets::SoftTissueField{} : plan.soft_tissue,
                       plan.laid ? &*plan.laid : nullptr);
}

void Equipment::start() {
  workstation_->start();
  if (source_.library) unplug_watch_.emplace(*workstation_);
  workstation_->note("start", source_.name);
  if (!second_hand_) return;
  second_hand_->start();
  workstation_->note(kSecondHandNamed, second_hand_->name());
}

std::vector<ControlRequest> Equipment::takeRequests() {
  std::vector<ControlRequest> requests;
  for (const haptics::HandAction action : workstation_->takeActions())
    if (const auto request = requestOf(action)) requests.push_back(*request);
  return requests;
}

StationHealth Equipment::health() {
  StationHealth health{workstation_->trips(), workstation_->deviceTrouble(), workstation_->recordingTrouble(), {}};
  const auto add = [&](const std::optional<std::string>& news) {
    if (news) health.news.push_back(*news);
  };
  if (unplug_watch_) add(unplug_watch_->takeNews());
  if (second_hand_) add(second_hand_->takeNews());
  return health;
}

}  // namespace app
