#include "app/commands/calibrate/wizard_option.h"

#include <csignal>
#include <cstdio>

#include <CLI/CLI.hpp>

#include "app/calibrate/base_rig.h"
#include "app/calibrate/wizard_show.h"
#include "app/device_choice.h"
#include "app/practice_device.h"
#include "app/rig_choice.h"
#include "app/usage_error.h"

namespace app {
namespace {

using namespace calibration;

volatile std::sig_atomic_t interrupted = 0;

void tell(const std::string& line) { std::fprintf(stderr, "molar: %s\n", line.c_str()); }

/// What is believed before: as named, else the one in force of this device, else as the workstation is built.
RigRecord recordBefore(const std::string& rig, const RigStore& store, const RigPlace& place) {
  if (!rig.empty()) return baseRig(rig);
  if (auto current = store.current(place)) return *current;
  return baseRig("mirrored");
}

}  // namespace

CLI::Option* WizardOption::addTo(CLI::App& command) {
  auto* device = command.add_option("--device", device_,
                                    "Stylus: openhaptics[:NAME], or practice:D[:SEED], one in numbers on which nothing "
                                    "can break (mouse moves it, space is its button)");
  auto* robot = command.add_flag("--robot", robot_, "A robot holds the practice stylus and does what the pages say");
  command.add_flag("--hurried", hurried_, "The robot takes no time")->needs(robot);
  command.add_flag("--headless", headless_, "The robot without a window")->needs(robot);
  display_.addTo(command);
  command.add_option("--monitor", monitor_, "Monitor, from 1")->check(CLI::Range(1, 16));
  command.add_flag("--windowed", windowed_, "In a window instead of the full screen");
  command.add_flag("--quiet", quiet_, "Without sounds");
  command.add_option("--pages", pages_, "A picture of every page into this folder")->type_name("DIR");
  return device;
}

WizardOption::Led WizardOption::run(Procedure procedure, const std::string& method, const std::string& rig,
                                    const RigStore& store, Measuring& measuring) const {
  const auto practice = practiceRig(device_);
  if (robot_ && !practice) throw UsageError("--robot: it holds a practice stylus only, use --device practice:D");
  WizardRun run;
  OpenedDevice opened;
  DeviceAtHand hand;
  if (practice) {
    hand = deviceAtHand(device_, nullptr);
    run.practice = practice;
    if (robot_) run.robot = TechnicianHabits{};
    run.plan.settle_s = hurried_ ? 0.0 : run.plan.settle_s;
  } else if (namesRealDevice(device_)) {
    DeviceOptions options;
    options.tell = tell;
    options.given_up = [] { return interrupted != 0; };
    opened = openDevice(device_, options);
    hand = deviceAtHand(device_, &opened.device->capabilities());
    run.device = opened.device.get();
    run.plan.has_inkwell = opened.device->capabilities().has_inkwell;
    if (opened.device->capabilities().arm_model.empty())
      throw UsageError("--device " + device_ + ": the geometry of a " + hand.model +
                       " is not known, so its arm can not be calibrated; a Phantom or Touch can");
  } else {
    throw UsageError("--device " + device_ + ": it has no stylus to touch with, use openhaptics[:NAME] or practice:D");
  }

  if (measuring.serial.empty()) measuring.serial = hand.serial;
  run.plan.procedure = procedure;
  run.plan.method = method;
  run.plan.jig = jig;
  run.plan.rest_marks_mm = rest_marks_mm;
  run.plan.device = {hand.model, measuring.serial, measuring.mount, measuring.stylus_tip};
  run.plan.record = practice && rig.empty() && !store.currentName({measuring.rig_id, measuring.serial, measuring.mount})
                        ? RigRecord{.rig = practice->nominal}
                        : recordBefore(rig, store, {measuring.rig_id, measuring.serial, measuring.mount});
  run.hurried = hurried_;
  run.windows = !headless_;
  run.sounds = !quiet_ && !headless_;
  run.display = {display_.mode(), display_.swapped(), !windowed_,
                 monitor_ ? std::optional(*monitor_ - 1) : std::nullopt};
  display_.refuseUnlessFits(run.plan.record.rig);
  run.pages = pages_;
  run.tell = tell;
  for (const int asked : {SIGINT, SIGTERM, SIGHUP}) std::signal(asked, [](int) { interrupted = 1; });
  run.given_up = [] { return interrupted != 0; };
  Led led{run.plan, runWizard(run)};
  if (!led.outcome.reason.empty()) tell(led.outcome.reason);
  return led;
}

}  // namespace app
