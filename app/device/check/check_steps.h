// The steps of a device check, in the order they are safe in. Each asks, looks, adds lines to the report, and answers
// false when the person wants to leave; the force is down between steps. Main thread.
#pragma once

#include "app/device/check/check_report.h"
#include "app/device/check/constant_force_loop.h"
#include "app/device/check/dialogue.h"
#include "app/device/check/force_scale_fit.h"
#include "app/device/check/owner.h"

namespace app {

/// Where a person who sits before the device finds its frame D.
struct DeviceAxes {
  glm::dvec3 right_D{1.0, 0.0, 0.0}, up_D{0.0, 1.0, 0.0}, towards_D{0.0, 0.0, 1.0};
};

/// What every step works at.
struct CheckBench {
  Dialogue& dialogue;
  ConstantForceLoop& hand;
  Owner& owner;
  const haptics::DeviceCapabilities& device;
  DeviceAxes axes;
  CheckReport& report;

  /// True once the owner did it.
  bool asked(OwnerTask task, const std::string& to_do) {
    owner.perform(task);
    return dialogue.asked(to_do);
  }
  /// A line of the report, and what it proves where it is right.
  void saw(std::string what, std::string expected, std::string found, bool is_right, std::optional<Proof> proof = {}) {
    report.lines.push_back(
        {std::move(what), std::move(expected), std::move(found), is_right ? Verdict::ok : Verdict::wrong});
    if (is_right && proof) report.proved.push_back(*proof);
  }
  void sawNone(const std::string& part) { report.lines.push_back({part, "none", "none", Verdict::not_there}); }
};

bool checkInkwell(CheckBench& bench);
bool checkDeadman(CheckBench& bench);
bool checkButtons(CheckBench& bench);
/// Nothing else may push when this found a wrong sign.
bool checkForceSign(CheckBench& bench, bool& sign_is_right);
/// What the balance showed of what was asked, down positive, is left in `readings`.
bool checkForceScale(CheckBench& bench, std::vector<ForceReading>& readings);
bool checkAxes(CheckBench& bench);
bool checkRate(CheckBench& bench, double rate_Hz, double seconds);

}  // namespace app
