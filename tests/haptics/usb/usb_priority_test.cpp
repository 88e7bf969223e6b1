// The thread that reads a device's USB lies one above the servo that its user has chosen.

#include <gtest/gtest.h>
#include <sched.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "haptics/device/opened_device.h"
#include "tests/haptics/usb/simulated_falcon.h"
#include "tests/haptics/usb/simulated_wooden.h"

namespace haptics {
namespace {

using simulated_usb::Bus;

bool mayHavePriority() {
  const sched_param before{}, wanted{.sched_priority = 21};
  const bool may = sched_setscheduler(0, SCHED_FIFO, &wanted) == 0;
  sched_setscheduler(0, SCHED_OTHER, &before);
  return may;
}

int usbThreadsPriority() {
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    std::string name;
    std::ifstream(task.path() / "comm") >> name;
    sched_param param{};
    if (name == "molar-usb" && sched_getparam(std::stoi(task.path().filename().string()), &param) == 0)
      return param.sched_priority;
  }
  return -1;
}

/// What the thread has while the device waits for its owner, who then gives up.
std::vector<int> seenWhileOpening(OpenedDevice (*open)(const std::string&, const DeviceOptions&)) {
  std::vector<int> seen;
  DeviceOptions options;
  options.servo_priority = 20;
  options.is_cancelled = [&] {
    seen.push_back(usbThreadsPriority());
    return true;
  };
  EXPECT_THROW(open("", options), DeviceError);
  return seen;
}

TEST(UsbPriority, LiesOneAboveTheServosThatWasChosen) {
  if (!Bus::available()) GTEST_SKIP() << "umockdev is not there: run under umockdev-wrapper";
  if (!mayHavePriority()) GTEST_SKIP() << "this user may have no real-time priority, see molar doctor";
  simulated_usb::SimulatedWooden wooden;
  simulated_usb::SimulatedFalcon falcon;
  falcon.runs = true;
  falcon.homed = 0;
  simulated_usb::Description beside = simulated_usb::SimulatedFalcon::description();
  beside.port = "2";
  beside.number = 3;
  Bus bus;
  bus.plug(simulated_usb::SimulatedWooden::description(), wooden);
  bus.plug(beside, falcon);
  EXPECT_EQ(seenWhileOpening(openWooden), std::vector{21});
  EXPECT_EQ(seenWhileOpening(openFalcon), std::vector{21});
}

}  // namespace
}  // namespace haptics
