// All that is plugged in for one rehearsal: the hand, the other hand, the pedal, and the workstation that joins them
// with the bone. Opened when constructed; join() makes the workstation, once it is known which command is in force.
// Main thread; devices and servo have threads of their own.
#pragma once

#include <optional>
#include <vector>

#include "app/controls/control.h"
#include "app/instructor/rehearsal_status.h"
#include "app/rehearsal/rehearsal_plan.h"
#include "app/rehearsal/run_monitor.h"
#include "app/station/unplug_watch.h"

namespace app {

class Equipment {
 public:
  /// Takes over the plan's open device. Throws as openPoseSource does.
  explicit Equipment(RehearsalPlan& plan);

  double rate_Hz() const { return rate_Hz_; }
  /// Of a hand that ends by itself.
  std::optional<double> duration_s() const { return hand_.duration_s; }
  /// What the hand asks for beside moving.
  const std::vector<TimedRequest>& asks() const { return hand_.asks; }
  double damping_Ns_per_mm() const { return damping_Ns_per_mm_; }
  /// Where the window moves the hand, else nullptr.
  haptics::MouseDevice* mouse() { return hand_.mouse; }
  SecondHand* secondHand() { return second_hand_ ? &*second_hand_ : nullptr; }

  /// Opens the recording. Throws SessionError or haptics::DeviceError.
  void join(const RehearsalPlan& plan, const haptics::Command& in_force);
  Workstation& workstation() { return *workstation_; }
  void start();

  /// What buttons and pedal have asked for since the last call.
  std::vector<ControlRequest> takeRequests();
  StationHealth health();
  void describe(RehearsalStatus& status) const;

 private:
  PoseSource hand_;
  double rate_Hz_, damping_Ns_per_mm_;
  std::optional<SecondHand> second_hand_;
  std::optional<haptics::FootPedal> pedal_;
  std::optional<Workstation> workstation_;
  std::optional<UnplugWatch> unplug_watch_;
};

}  // namespace app
