// The whole check of one unit by its owner: inkwell, deadman, buttons, axes, sign and scale of the force, rate. Ten
// minutes with a person; every force passes the safety layer and the motor gate; motors off at the end, however it
// ends. Main thread.
#pragma once

#include "app/device/check/check_report.h"
#include "app/device/check/check_steps.h"
#include "app/device/check/dialogue.h"
#include "haptics/loop/served_device.h"

namespace app {

struct DeviceCheckPlan {
  std::string address;
  DeviceAxes axes;
  double rate_Hz = 1000.0, rate_seconds = 10.0;
};

struct DeviceCheck {
  CheckReport report;
  std::vector<ForceReading> readings;  ///< of the balance, down positive
};

/// A stepped device takes no time of its own. Throws DeviceError when the device cannot be started.
DeviceCheck checkDevice(haptics::ServedDevice served, const DeviceCheckPlan& plan, Owner& owner, Dialogue& dialogue);

/// Of a device of this address.
DeviceAxes axesAt(const std::string& address);

}  // namespace app
