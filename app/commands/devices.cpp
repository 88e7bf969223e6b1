// `molar devices`: what is there and what drives it. `molar devices check`: its owner tests a unit and gets a report.

#include <signal.h>

#include <cstdio>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <memory>

#include "app/commands/command.h"
#include "app/device/check/device_check.h"
#include "app/device/check/simulated_owner.h"
#include "app/device/device_table.h"
#include "app/device/falcon_scale_file.h"
#include "app/text/command_line.h"
#include "app/text/message.h"
#include "app/text/terminal_format.h"
#include "app/text/usage_error.h"
#include "app/text/version.h"
#include "calibration/arm/phantom_models.h"
#include "calibration/output_file.h"
#include "haptics/device/device_catalogue.h"
#include "haptics/device/simulated/simulated_phantom.h"

namespace app {
namespace {

struct CheckOptions {
  std::string address, report = "molar-device-check.md", falcon_firmware, falcon_scale;
  double rate_Hz = 1000.0, rate_seconds = 10.0;
  bool force = false;
};

/// An interrupt ends the question that is open, and so the check, in order.
void endQuestionsOnInterrupt() {
  struct sigaction action {};
  action.sa_handler = [](int) {};
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

std::string firstRealDevice() {
  for (const haptics::FoundDevice& found : haptics::findDevices().devices)
    if (haptics::isDeviceAddress(found.address)) return found.address;
  throw UsageError(
      "devices check: no device that Molar drives is here, plug one in and see molar devices, or try the "
      "check itself with simulated:omni");
}

/// A unit, and who holds it.
struct Unit {
  std::unique_ptr<Owner> owner;
  haptics::OpenedDevice opened;
  haptics::SimulatedDevice* simulated = nullptr;  ///< stepped, without a clock

  haptics::ServedDevice served() const {
    return simulated ? haptics::ServedDevice::steppedManually(*simulated) : haptics::ServedDevice(*opened.device);
  }
};

Unit unitAt(const std::string& address, const CheckOptions& options, haptics::FalconForceScale& scale) {
  constexpr std::string_view kSimulated = "simulated:";
  Unit unit;
  if (address.starts_with(kSimulated)) {
    const haptics::PhantomMechanics* phantom = haptics::findSimulatedPhantom(address.substr(kSimulated.size()));
    if (phantom == nullptr)
      throw UsageError("devices check " + address + ": no such device, choose one of " +
                       calibration::phantomModelKeys());
    auto hand = std::make_unique<SimulatedOwner>(*phantom);
    auto simulated = std::make_unique<haptics::SimulatedPhantom>(*phantom, hand->script());
    unit.simulated = simulated.get();
    unit.opened.device = std::move(simulated);
    unit.opened.address = address;
    unit.owner = std::move(hand);
    return unit;
  }
  haptics::DeviceOptions device;
  device.falcon_program = options.falcon_firmware;
  device.falcon_scale = [&] { return scale = savedFalconScale(options.falcon_scale); };
  device.report = printMessage;
  unit.opened = haptics::openDevice(address, device);
  unit.owner = std::make_unique<Owner>();
  return unit;
}

std::string today() {
  const std::time_t now = std::time(nullptr);
  char text[32] = "";
  std::tm local{};
  if (localtime_r(&now, &local) != nullptr) std::strftime(text, sizeof text, "%Y-%m-%d %H:%M", &local);
  return text;
}

/// Keeps the measured force scale of a Falcon.
void keepFalconScale(const CheckOptions& options, const haptics::FalconForceScale& used, const DeviceCheck& check) {
  haptics::FalconForceScale scale = haptics::weighed(used, check.readings);
  scale.serial = check.report.device.serial;
  std::error_code none;
  std::filesystem::create_directories(std::filesystem::path(options.falcon_scale).parent_path(), none);
  writeFalconScale(options.falcon_scale, scale, true);
  printMessage("the force scale is kept in " + options.falcon_scale);
}

int check(const CheckOptions& options) {
  calibration::OutputFile report(options.report, options.force);
  haptics::FalconForceScale scale;
  const Unit unit = unitAt(options.address.empty() ? firstRealDevice() : options.address, options, scale);
  const std::string address = unit.opened.address;
  endQuestionsOnInterrupt();
  Dialogue dialogue(std::cin, std::cerr);
  dialogue.say("Check of " + unit.opened.device->capabilities().model + ". q leaves at any question, motors off.");

  const DeviceCheckPlan plan{address, axesAt(address), options.rate_Hz, options.rate_seconds};
  DeviceCheck done = checkDevice(unit.served(), plan, *unit.owner, dialogue);
  done.report.date = today();
  done.report.program = programVersion();
  if (address.starts_with("falcon") && done.readings.size() >= 3) keepFalconScale(options, scale, done);

  report.commit(pageOf(done.report));
  dialogue.say("\n" +
               std::string(done.report.left_early ? "Left before the end."
                           : done.report.isGood() ? "Everything tried is as it should be."
                                                  : "Something is wrong: do not use this unit until it is "
                                                    "repaired.") +
               " The report: " + options.report);
  return done.report.isGood() ? 0 : 1;
}

int list(bool json) {
  const haptics::DeviceCatalogue catalogue = haptics::findDevices();
  std::fputs((json ? asJson(catalogue) : asText(catalogue, terminalFormat())).c_str(), stdout);
  return 0;
}

}  // namespace

void addDevices(CommandLine& molar) {
  auto json = std::make_shared<bool>(false);
  auto o = std::make_shared<CheckOptions>();
  o->falcon_scale = defaultFalconScaleFile();
  CommandLine& devices = molar.command("devices", "What is plugged in and what drives it; test of a unit");
  devices.flag("--json", *json, "For programs");
  CommandLine& command = devices.command("check", "Test a unit, ten minutes with a kitchen balance: a report");
  command.option("ADDRESS", o->address, "As molar devices lists it, or simulated:omni [the first real one]");
  command.option("--report", o->report, "The page to write, Markdown").valueNamed("FILE").showsDefault();
  command.flag("--force", o->force, "Replace a report that exists");
  command.option("--rate", o->rate_Hz, "Servo rate, Hz").from(500.0, 10'000.0).showsDefault();
  command.option("--rate-seconds", o->rate_seconds, "How long the rate is watched, s").from(0.5, 600.0).showsDefault();
  command.option("--falcon-firmware", o->falcon_firmware, "Novint's firmware for a Falcon").valueNamed("FILE");
  command.option("--falcon-scale", o->falcon_scale, "Where a Falcon's force scale is kept").valueNamed("FILE");
  command.does([o] { return check(*o); });
  devices.does([json] { return list(*json); });
}

}  // namespace app
