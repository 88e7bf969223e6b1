#include "app/device/check/device_check.h"

#include <functional>

#include <fmt/core.h>

#include "app/device/emergency_exit.h"
#include "haptics/safety/fault.h"

namespace app {
namespace {

void addFacts(CheckReport& report) {
  const haptics::DeviceCapabilities& can = report.device;
  report.lines.push_back({"peak and lasting force", "as its maker states",
                          fmt::format("{:.1f} N, {:.2f} N{}", can.peak_force_N, can.continuous_force_N,
                                      can.force_is_calibrated ? "" : ", never measured"),
                          Verdict::ok});
}

/// The steps, each relying on the ones before; false: the user left.
bool runSteps(CheckBench& bench, const DeviceCheckPlan& plan, std::vector<ForceReading>& readings) {
  int number = 0;
  const auto begin = [&](const char* title) { bench.dialogue.say(fmt::format("\n{}. {}", ++number, title)); };
  bool sign_is_right = false;
  begin("Inkwell");
  if (!checkInkwell(bench)) return false;
  begin("Deadman");
  if (!checkDeadman(bench)) return false;
  begin("Buttons");
  if (!checkButtons(bench)) return false;
  begin("Axes");
  if (!checkAxes(bench)) return false;
  begin("Which way it pushes");
  if (!bench.device.has_motors) {
    bench.sawNone("force");
  } else {
    if (!checkForceSign(bench, sign_is_right)) return false;
    begin("How strong it is");
    if (!sign_is_right) {
      bench.dialogue.say("  It pushed the wrong way: it must not push again before that is repaired.");
      bench.report.lines.push_back({"scale of the force", "1.00 ± 0.10", "", Verdict::not_tried});
    } else if (!checkForceScale(bench, readings)) {
      return false;
    }
  }
  begin("Rate");
  return checkRate(bench, plan.rate_Hz, plan.rate_seconds);
}

}  // namespace

DeviceAxes axesAt(const std::string& address) {
  // WoodenHaptics: x out of the base towards the user, z up (usb/wooden_kinematics).
  if (address.starts_with("wooden")) return {{0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}};
  return {};
}

DeviceCheck checkDevice(haptics::ServedDevice served, const DeviceCheckPlan& plan, Owner& owner, Dialogue& dialogue) {
  DeviceCheck check;
  check.report.address = plan.address;
  check.report.device = served.device.capabilities();
  addFacts(check.report);

  ConstantForceLoop hand(served, plan.rate_Hz);
  hand.start();
  {
    const EmergencyExit emergency(hand);
    CheckBench bench{dialogue, hand, owner, check.report.device, plan.axes, check.report};
    check.report.left_early = !runSteps(bench, plan, check.readings);
    hand.push(glm::dvec3(0.0));
    hand.stop();
  }
  if ((hand.newest().tripped & static_cast<std::uint32_t>(haptics::Fault::device)) != 0)
    check.report.lines.push_back({"device", "healthy throughout", "it reported trouble", Verdict::wrong});
  return check;
}

}  // namespace app
