// The steps of a device check, in the order in which they are safe. Each prompts the user, measures, adds lines to the
// report, and returns false when the user wants to leave; the force is off between steps. Main thread.
#pragma once

#include "app/device/check/check_report.h"
#include "app/device/check/constant_force_loop.h"
#include "app/device/check/dialogue.h"
#include "app/device/check/force_scale_fit.h"

namespace app {

/// Directions in frame D, as seen by a user in front of the device.
struct DeviceAxes {
  glm::dvec3 right_D{1.0, 0.0, 0.0}, up_D{0.0, 1.0, 0.0}, towards_D{0.0, 0.0, 1.0};
};

/// What every step works with.
struct CheckBench {
  Dialogue& dialogue;
  ConstantForceLoop& hand;
  Owner& owner;
  const haptics::DeviceCapabilities& device;
  DeviceAxes axes;
  CheckReport& report;

  /// True once the user did it.
  bool confirm(OwnerTask task, const std::string& to_do) {
    owner.perform(task);
    return dialogue.confirm(to_do);
  }
  /// Adds a line to the report, and what it confirms if it is right.
  void saw(std::string what, std::string expected, std::string found, bool is_right,
           std::optional<Evidence> evidence = {}) {
    report.lines.push_back(
        {std::move(what), std::move(expected), std::move(found), is_right ? Verdict::ok : Verdict::wrong});
    if (is_right && evidence) report.confirmed.push_back(*evidence);
  }
  void sawNone(const std::string& part) { report.lines.push_back({part, "none", "none", Verdict::not_there}); }
};

bool checkInkwell(CheckBench& bench);
bool checkDeadman(CheckBench& bench);
bool checkButtons(CheckBench& bench);
/// After a wrong sign no other step may push.
bool checkForceSign(CheckBench& bench, bool& sign_is_right);
/// Requested forces and the balance's answers, down positive, go to `readings`.
bool checkForceScale(CheckBench& bench, std::vector<ForceReading>& readings);
bool checkAxes(CheckBench& bench);
bool checkRate(CheckBench& bench, double rate_Hz, double seconds);

// Waits, polled a hundred times a second of the device's time, for ten seconds at most (bench_waits.cpp).

/// Pushes until the delivered force is the requested one, or all that the device gives.
bool pushUntilSteady(CheckBench& bench, const glm::dvec3& force_D_N);
void letGo(CheckBench& bench);
/// The state once the handle has come to rest, after three seconds at most.
ConstantForceLoop::Seen stateAtRest(CheckBench& bench);
/// "+0.50, 0.00, 0.00 N"
std::string newtons(const glm::dvec3& force_N);

}  // namespace app
