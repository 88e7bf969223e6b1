#include "app/commands/calibrate/wizard_option.h"

#include <csignal>
#include <cstdio>
#include <utility>

#include "app/calibrate/run_webcam.h"
#include "app/calibrate/run_wizard.h"
#include "app/device/practice_device.h"
#include "app/options/view_option.h"
#include "app/station/rig_choice.h"
#include "app/text/command_line.h"
#include "app/text/message.h"
#include "app/text/usage_error.h"
#include "calibration/webcam/camera_file.h"
#include "calibration/webcam/webcam_source.h"
#include "haptics/device/device_catalogue.h"

namespace app {
namespace {

using namespace calibration;

constexpr double kPracticeSettle_s = 3.0;

volatile std::sig_atomic_t interrupted = 0;

RigLocation placeOf(const MeasurementInfo& info) { return {info.rig_id, info.serial, info.mount}; }

/// A practice device is used at a plain monitor: upright, without the workstation's mirror. The device stays where it
/// stands on the workstation, so that all targets are within its reach.
Rig practiceDesk(const Rig& workstation) {
  Rig desk = desktopRig(workstation.screen.px);
  desk.device = workstation.device;
  desk.X_WD = workstation.X_WD;
  return desk;
}

}  // namespace

Option WizardOption::addTo(CommandLine& command) {
  Option device = command.option("--device", device_,
                                 "Stylus: openhaptics[:NAME], or practice:D[:SEED], a simulated one on which nothing "
                                 "can break, at a plain monitor unless --rig has a mirror (keys on every page)");
  Option robot = command.flag("--robot", robot_, "A robot holds the practice stylus and does what the pages say");
  command.flag("--hurried", hurried_, "The robot takes no time").needs(robot);
  command.flag("--headless", headless_, "The robot without a window").needs(robot);
  display_.addTo(command);
  command.option("--monitor", monitor_, "Monitor, from 1").wholeFrom(1, 16);
  command.flag("--windowed", windowed_, "In a window instead of the full screen");
  command.flag("--quiet", quiet_, "Without sounds");
  command.flag("--verbose", tells_, "What the pages say on the terminal as well, for whoever assists");
  command.option("--pages", pages_, "A picture of every page into this folder").valueNamed("DIR");
  return device;
}

void WizardOption::addCameraTo(CommandLine& command) {
  command.option("--camera", camera_, "Webcam for webcam3: its number or path [practice: a rendered one]");
  command.option("--camera-size", camera_size_, "Size of its pictures").valueNamed("WxH").showsDefault();
  command.option("--lens", lens_, "Camera file of its lens [measured on the way]").valueNamed("FILE");
  command.flag("--gray-code", gray_code_, "Stripes instead of a chessboard on the screen");
}

WizardOption::Stylus WizardOption::stylus(MeasurementInfo& info) const {
  for (const int asked : {SIGINT, SIGTERM, SIGHUP}) std::signal(asked, [](int) { interrupted = 1; });
  Stylus stylus;
  stylus.practice = practiceRig(device_);
  DeviceIdentity hand;
  if (stylus.practice) {
    hand = deviceIdentity(device_, nullptr);
    stylus.practice->nominal = practiceDesk(stylus.practice->nominal);
  } else if (robot_) {
    throw UsageError("--robot: it holds a practice stylus only, use --device practice:D");
  } else if (haptics::isDeviceAddress(device_)) {
    haptics::DeviceOptions options;
    options.report = printMessage;
    options.is_cancelled = [] { return interrupted != 0; };
    stylus.opened = haptics::openDevice(device_, options);
    hand = deviceIdentity(device_, &stylus.opened.device->capabilities());
    if (stylus.opened.device->capabilities().arm_model.empty())
      throw UsageError("--device " + device_ + ": the arm of a " + hand.model +
                       " is not known well enough to be calibrated; that of a Phantom or Touch is");
  } else {
    throw UsageError("--device " + device_ + ": it has no stylus to touch with, use openhaptics[:NAME] or practice:D");
  }
  stylus.model = hand.model;
  if (info.serial.empty()) info.serial = hand.serial;
  return stylus;
}

/// The rig to start from: as named, else the current one of this device, else the nominal workstation, or for practice
/// a plain monitor.
RigRecord WizardOption::before(const Stylus& stylus, const std::string& rig, const RigStore& store,
                               const MeasurementInfo& info) const {
  RigRecord record;
  if (!rig.empty()) {
    record = baseRig(rig);
  } else if (auto current = store.current(placeOf(info))) {
    record = *std::move(current);
  } else if (stylus.practice) {
    record.rig = stylus.practice->nominal;
  } else {
    record = baseRig("mirrored");
  }
  if (record.provenance.rig_id.empty()) record.provenance.rig_id = info.rig_id;
  display_.refuseUnlessFits(record.rig);
  return record;
}

void WizardOption::prepare(GuidedRun& run, const Stylus& held) const {
  run.device = held.opened.device.get();
  run.practice = held.practice;
  run.windows = !headless_;
  run.sounds = !quiet_ && !headless_;
  run.display = {display_.mode(), display_.swapped(), !windowed_,
                 monitor_ ? std::optional(*monitor_ - 1) : std::nullopt};
  run.report = printMessage;
  run.interrupted = [] { return interrupted != 0; };
}

WizardOption::GuidedOutcome WizardOption::guide(CalibrationProcedure procedure, const std::string& method,
                                                const std::string& rig, const RigStore& store,
                                                MeasurementInfo info) const {
  const Stylus held = stylus(info);
  WizardRun run;
  run.plan.procedure = procedure;
  run.plan.method = method;
  run.plan.jig = jig;
  run.plan.rest_marks_mm = rest_marks_mm;
  run.plan.device = {held.model, info.serial, info.mount, info.stylus_tip};
  run.plan.record = before(held, rig, store, info);
  prepare(run, held);
  if (run.device != nullptr) run.plan.has_inkwell = run.device->capabilities().has_inkwell;
  if (robot_) {
    run.robot = TechnicianSettings{};
    run.practice->technician.outlier_share = 0.0;
  }
  // A simulated arm has no motors that settle: the page is shown.
  if (held.practice) run.plan.settle_s = hurried_ ? 0.0 : kPracticeSettle_s;
  run.hurried = hurried_;
  run.tells = tells_;
  run.pages = pages_;
  GuidedOutcome led{run.plan, runWizard(run), info};
  if (!led.outcome.reason.empty()) printMessage(led.outcome.reason);
  return led;
}

WizardOption::Seen WizardOption::guideWebcam(const std::string& rig, const RigStore& store,
                                             MeasurementInfo info) const {
  const Stylus held = stylus(info);
  Seen seen;
  seen.before = before(held, rig, store, info);
  WebcamRun run;
  run.plan.rig = seen.before.rig;
  run.plan.places = *targetPlan("webcam27");
  if (!lens_.empty()) run.plan.lens = readCamera(lens_).camera;
  run.plan.gray_code = gray_code_;
  run.plan.device_model = held.model;
  run.plan.serial = info.serial;
  run.plan.mount = info.mount;
  const glm::ivec2 size_px = imageSize(camera_size_);
  OpenedImageSource webcam;
  if (!camera_.empty()) {
    WebcamSettings wanted;
    wanted.device = camera_;
    wanted.size_px = size_px;
    webcam = openImageSource(wanted);
    if (!webcam.remarks.empty()) printMessage(webcam.images->name() + ": " + webcam.remarks);
    run.images = webcam.images.get();
  }
  prepare(run, held);
  run.practice_px = size_px;
  run.robot = robot_;
  seen.observations = runWebcam(run);
  seen.info = info;
  return seen;
}

}  // namespace app
