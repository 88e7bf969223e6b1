// Devices of one rehearsal: pose source, second hand, pedal, and the workstation that connects them with the bone.
// Devices open on construction; connect() makes the workstation once the first command is known. Main thread; devices
// and servo have threads of their own.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/controls/control.h"
#include "app/rehearsal/rehearsal_plan.h"
#include "app/rehearsal/run_monitor.h"
#include "app/station/unplug_watch.h"

namespace app {

class Equipment {
 public:
  /// Takes over the plan's open device. Throws as openPoseSource does.
  explicit Equipment(RehearsalPlan& plan);

  const std::string& deviceName() const { return source_.name; }
  double rate_Hz() const { return rate_Hz_; }
  /// Of a pose source with an end.
  std::optional<double> duration_s() const { return source_.duration_s; }
  /// Of a scripted pose source.
  const std::vector<TimedRequest>& scriptedRequests() const { return source_.requests; }
  /// The device pushes: it is armed, and its motors can be switched off.
  bool hasMotors() const { return has_motors_; }
  double damping_Ns_per_mm() const { return damping_Ns_per_mm_; }
  /// A person holds it: another instrument works where the one before it did.
  bool isHeldByEnd() const { return source_.held_by_end; }
  /// Null unless the mouse is the pose source.
  haptics::MouseDevice* mouse() { return source_.mouse; }
  /// Null unless a procedure leads the hand.
  haptics::LedHand* led() { return source_.led; }
  SecondHand* secondHand() { return second_hand_ ? &*second_hand_ : nullptr; }

  /// Opens the recording. Throws SessionError or haptics::DeviceError.
  void connect(const RehearsalPlan& plan, const haptics::Command& in_force);
  Workstation& workstation() { return *workstation_; }
  void start();

  /// From buttons and pedal, since the last call; without the handle's change of tool.
  std::vector<ControlRequest> takeRequests();
  Workstation::ToolButton toolButton() const { return workstation_->toolButton(); }
  StationHealth health();
  /// Why nothing is recorded any more; none: it is, or was not to be.
  std::optional<std::string> recordingTrouble() const { return workstation_->recordingTrouble(); }

 private:
  PoseSource source_;
  double rate_Hz_, damping_Ns_per_mm_;
  bool has_motors_;
  std::optional<SecondHand> second_hand_;
  std::optional<haptics::FootPedal> pedal_;
  std::optional<Workstation> workstation_;
  std::optional<UnplugWatch> unplug_watch_;
};

}  // namespace app
