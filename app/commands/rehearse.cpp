// `molar rehearse [PATIENT]`: the rehearsal.

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <thread>

#include "app/case/case.h"
#include "app/case/patient_placement.h"
#include "app/case/patient_source.h"
#include "app/case/trough_plan.h"
#include "app/commands/command.h"
#include "app/controls/control.h"
#include "app/device/falcon_scale_file.h"
#include "app/device/pose_source_table.h"
#include "app/options/command_settings.h"
#include "app/options/display_option.h"
#include "app/options/law_text.h"
#include "app/options/pedal_option.h"
#include "app/options/picture_option.h"
#include "app/options/tool_text.h"
#include "app/options/view_option.h"
#include "app/rehearsal/continuation.h"
#include "app/rehearsal/live_view.h"
#include "app/rehearsal/recording_check.h"
#include "app/rehearsal/rehearsal.h"
#include "app/session/session_error.h"
#include "app/session/session_folder.h"
#include "app/station/case_reach.h"
#include "app/station/rig_choice.h"
#include "app/text/command_line.h"
#include "app/text/message.h"
#include "app/text/usage_error.h"
#include "app/view/preparation.h"
#include "assets/patient/patient_folder.h"
#include "assets/tooth.h"
#include "calibration/record/utc.h"
#include "haptics/device/device_catalogue.h"
#include "render/quality_ladder.h"

namespace app {
namespace {

constexpr double kForeignFaceWindow_mm = 24.0;

struct RehearseOptions {
  RehearsalPlan plan;
  std::string patient, pedal = "auto", falcon_firmware, record, continued, face;
  bool no_record = false;
  RigOption rig;
  std::vector<std::string> tools{"round:3.0", "round:2.0", "fissure:1.6,4.5"};
  std::string shaft, law = "agus", erosion = "time", size, snapshot_size = "1280x800";
  std::string pace = "real";
  std::string side = "right", second_tool = "mirror", case_name;
  bool list_cases = false;
  PictureOption picture;
  std::vector<std::string> settings;
  DisplayOption display;
  assets::JawParameters jaw;
  std::optional<double> face_window_mm;
  std::optional<std::string> position;
  std::optional<int> monitor;
  double loupes = 4.0;
  bool no_line = false;
};

/// Without a rig: a desktop monitor, its image magnified (--loupes). With one everything is 1:1, and the patient's pose
/// is the rig's, or else has the operated tooth at the origin of W.
calibration::Rig rigFor(const RehearseOptions& options, const std::optional<ChosenRig>& chosen) {
  calibration::Rig rig;
  if (chosen) {
    rig = chosen->record.rig;
    if (!options.size.empty()) rig.screen.px = imageSize(options.size);
  } else {
    const glm::ivec2 default_px = options.plan.headless ? glm::ivec2(640, 400) : glm::ivec2(1280, 800);
    rig = calibration::desktopRig(options.size.empty() ? default_px : imageSize(options.size),
                                  calibration::kDeskMonitorWidth_mm / options.loupes);
  }
  if (options.position && !hasNoPatientPose(rig))
    throw UsageError("--position " + *options.position + ": the rig states the pose of the head (X_WP), leave it out");
  return rig;
}

/// The device is opened first, as a rig belongs to one device and only the device knows its serial number.
std::optional<ChosenRig> chooseRig(RehearsalPlan& plan, const RehearseOptions& options, DeviceIdentity& device) {
  if (haptics::isDeviceAddress(options.plan.device))
    plan.opened = haptics::openDevice(options.plan.device, plan.device_options);
  device = deviceIdentity(options.plan.device, plan.opened ? &plan.opened->device->capabilities() : nullptr);
  if (plan.opened && !plan.opened->device->capabilities().has_orientation)
    plan.remarks.push_back(device.model + ": it measures no orientation, the handpiece keeps a fixed one");
  std::optional<ChosenRig> chosen = options.rig.choose(device, calibration::nowUtc());
  plan.rig = rigFor(options, chosen);
  plan.full_screen = chosen.has_value();
  plan.view_can_turn = !chosen && !haptics::isDeviceAddress(options.plan.device);
  if (!chosen) {
    if (device.kind == DeviceIdentity::Kind::real)
      plan.remarks.push_back("no calibration of " + device.model + " " + device.serial +
                             " is in force: hand and eye may be a centimetre apart, see molar calibrate");
    return chosen;
  }
  plan.calibration = chosen->calibration;
  if (device.isCalibrated() && chosen->calibration.rig != "default")
    plan.remarks.push_back(chosen->source + ": " + calibrationText(chosen->calibration));
  plan.remarks.insert(plan.remarks.end(), chosen->remarks.begin(), chosen->remarks.end());
  if (haptics::isDeviceAddress(options.plan.second_hand.device) && !plan.rig.second_X_WD)
    throw UsageError("--second-hand " + options.plan.second_hand.device + ": " + chosen->source +
                     " does not say where its base stands, add X_WD2");
  return chosen;
}

void placePatient(RehearsalPlan& plan, const RehearseOptions& options, const std::optional<ChosenRig>& chosen,
                  const DeviceIdentity& device, const assets::FacePose& X_PF) {
  // On the desktop X_WD is the identity: the tooth is at the origin of D, the middle of a Phantom's workspace.
  if (hasNoPatientPose(plan.rig))
    plan.rig.X_WP = placePatientAtSite(plan.patient, X_PF, patientPositionNamed(options.position.value_or("seated")));
  if (!chosen) return;
  const std::vector<std::string> fit = caseRemarks(plan.rig, plan.patient, chosen->record.eye_sd_mm,
                                                   device.isCalibrated() ? device.model : std::string());
  plan.remarks.insert(plan.remarks.end(), fit.begin(), fit.end());
}

/// Generated or read while the surgeon's windows show the progress. False: cancelled.
bool preparePatient(RehearsalPlan& plan, const RehearseOptions& options, const assets::JawParameters& jaw) {
  const SurgeonDisplay::Options shown = displayOf(plan);
  Preparation preparation({.windows = shown.windows,
                           .eyes_swapped = shown.eyes_swapped,
                           .headless = plan.headless,
                           .needs_window = shown.needs_window},
                          plan.rig, "Preparing the patient", printMessage);
  auto patient = preparation.run<assets::Patient>([&](const assets::ReportProgress& report) {
    return options.patient.empty() ? builtInPatient(jaw, report) : assets::loadPatient(options.patient);
  });
  if (!patient) return false;
  plan.patient = std::move(*patient);
  plan.windows = preparation.takeWindows();
  return true;
}

/// Without windows, devices and pedals, which run in real time.
void refuseUnlessSteppable(const RehearseOptions& options) {
  if (!options.plan.headless) throw UsageError("--pace fast: a window needs real time, add --headless");
  const PoseSourceKind* const hand = poseSourceKindOf(options.plan.device);
  if (!hand || !hand->simulated)
    throw UsageError("--pace fast: " + options.plan.device +
                     " is not simulated, choose --device scripted, simulated, practice, replay or poses");
  if (!options.plan.second_hand.device.empty() && haptics::isDeviceAddress(options.plan.second_hand.device))
    throw UsageError("--pace fast: --second-hand " + options.plan.second_hand.device +
                     " is not simulated, choose scripted or replay:SESSION");
  if (options.plan.instructor_window) throw UsageError("--pace fast: a window needs real time, leave --instructor out");
  if (options.pedal != "auto" && options.pedal != "none")
    throw UsageError("--pace fast: a pedal needs real time, leave --pedal out");
}

void planCut(RehearsalPlan& plan) {
  const auto planned = plannedCut(plan.patient, plan.command.tool.head.radius_mm);
  if (!planned) return;
  plan.cut = planned->cut;
  const PoseSourceKind* const hand = poseSourceKindOf(plan.device);
  if (planned->kind == CutKind::gutter || !hand || !hand->follows_plan) return;
  const std::string why = plan.patient.site ? "no gutter fits beside the " + assets::toothName(plan.patient.site->fdi)
                                            : std::string("no operated tooth is labelled");
  printMessage(why + ", the scripted cut is on the nearest bone");
}

/// Mesa's software renderer would use every core.
void reserveCoreForServo() {
  const unsigned cores = std::thread::hardware_concurrency();
  const std::string threads = std::to_string(cores > 1 ? cores - 1 : 1);
  setenv("LP_NUM_THREADS", threads.c_str(), 0);
}

/// A named case, or the built-in patient's single options; the voxels and the seed are asked for by themselves.
assets::JawParameters jawOf(const RehearseOptions& options) {
  assets::JawParameters jaw = options.jaw;
  jaw.right_side = options.side == "right";
  if (options.case_name.empty()) return jaw;
  jaw = caseNamed(options.case_name)->jaw;
  jaw.spacing_mm = options.jaw.spacing_mm;
  jaw.seed = options.jaw.seed;
  return jaw;
}

/// "replay:last" with the file.
std::string withSessionNamed(const std::string& device) {
  constexpr std::string_view kReplay = "replay:";
  return device.starts_with(kReplay) ? std::string(kReplay) + sessionNamed(device.substr(kReplay.size())) : device;
}

/// A rehearsal is recorded, whatever its hand. Without a folder for it the rehearsal goes on, and says so.
std::optional<Recording> defaultRecording(int fdi) {
  try {
    const std::filesystem::path folder = usualSessionFolder();
    makeSessionFolder(folder);
    const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
    Recording recording{newSessionPath(folder, now.time_since_epoch().count(), fdi)};
    recording.by_default = true;
    return recording;
  } catch (const SessionError& error) {
    printMessage(std::string("not recording, the rehearsal goes on: ") + error.what());
    return {};
  }
}

/// What was chosen on the command line stays; the rest is as it was at the end of the former session.
void goOn(RehearseOptions& options, const Continuation& former) {
  RehearsalPlan& plan = options.plan;
  static const RehearseOptions kUntouched;
  const haptics::Command chosen = std::exchange(plan.command, former.command);
  plan.command.safety = chosen.safety;
  if (options.law != kUntouched.law) plan.command.law = chosen.law;
  if (options.erosion != kUntouched.erosion) plan.command.erosion = chosen.erosion;
  if (options.tools != kUntouched.tools || !options.shaft.empty()) {
    plan.command.tool = chosen.tool;
  } else if (!former.setup.tray.empty()) {
    plan.other_tools = former.setup.tray;
    std::erase(plan.other_tools, plan.command.tool);
  }
  applyTo(plan.command, options.settings);
  plan.remarks.insert(plan.remarks.end(), former.remarks.begin(), former.remarks.end());
}

int run(RehearseOptions& options) {
  if (options.list_cases) {
    std::fputs(caseList().c_str(), stdout);
    return 0;
  }
  RehearsalPlan& plan = options.plan;
  plan.device = withSessionNamed(plan.device);
  plan.second_hand.device = withSessionNamed(plan.second_hand.device);
  std::optional<Continuation> former;
  const auto tool_of = [&](const std::string& text) {
    const haptics::BurShape head = headFrom(text);
    return haptics::Tool{head, options.shaft.empty() ? haptics::standardShaft(head) : shaftFrom(options.shaft)};
  };
  plan.command.tool = tool_of(options.tools.front());
  for (auto other = options.tools.begin() + 1; other != options.tools.end(); ++other)
    plan.other_tools.push_back(tool_of(*other));
  plan.command.erosion.kind = *haptics::erosionOfKey(options.erosion);
  plan.command.law.kind = lawNamed(options.law);
  applyTo(plan.command, options.settings);
  refuseBeyondServoLimits(plan.command);
  refuseUnlessAdmitted(plan.command);
  if (plan.headless && plan.instructor_window)
    throw UsageError(
        "--instructor: its window cannot open in a run without windows, leave out --instructor or --headless");
  if (plan.headless && plan.device == "mouse")
    throw UsageError("--headless: there is no mouse without a window, add --device scripted");
  refuseUnlessPoseSource(plan.device);
  options.rig.refuseUnlessReadable();
  if (options.pace == "fast") {
    refuseUnlessSteppable(options);
    plan.ticking = Ticking::stepped;
  } else {
    plan.pedal = pedalFrom(options.pedal);
    if (plan.pedal) refuseUnlessPlugged(*plan.pedal);
  }
  for (const assets::SecondInstrumentEntry& entry : assets::kSecondInstruments)
    if (entry.name == options.second_tool) plan.second_hand.tool = entry.instrument;
  refuseUnlessSecondHand(plan.second_hand, plan.device);
  plan.device_options.falcon_program = options.falcon_firmware;
  plan.device_options.falcon_scale = [] { return savedFalconScale(defaultFalconScaleFile()); };
  plan.device_options.report = printMessage;
  plan.display = options.display.mode();
  plan.head_up_line = !options.no_line;
  plan.eyes_swapped = options.display.swapped();
  plan.backend = options.picture.backend();
  options.picture.apply(plan.first_frame);
  if (options.monitor) plan.monitor = *options.monitor - 1;
  plan.snapshot_px = imageSize(options.snapshot_size);
  if (!plan.snapshot.empty() && plan.snapshot == plan.first_snapshot)
    throw UsageError("--first-snapshot " + plan.snapshot + ": the same as --snapshot, give another name");
  if (!options.record.empty())
    refuseUnlessRecordable(options.record, plan.overwrite, {plan.device, plan.second_hand.device});
  if (!options.record.empty()) plan.recording = Recording{options.record, plan.overwrite};
  if (!options.continued.empty()) {
    former = continuationOf(sessionNamed(options.continued));
    goOn(options, *former);
  }

  assets::JawParameters jaw = jawOf(options);
  if (former && former->setup.built_in) jaw = *former->setup.built_in;
  if (former && !former->setup.built_in && options.patient.empty())
    throw UsageError("--continue " + former->path +
                     ": is of an imported patient, name its folder: molar rehearse PATIENT --continue " +
                     options.continued);
  DeviceIdentity device;
  const std::optional<ChosenRig> chosen = chooseRig(plan, options, device);
  options.display.refuseUnlessFits(plan.rig);
  reserveCoreForServo();
  if (!preparePatient(plan, options, jaw)) {
    printMessage("left before the patient was ready");
    return 0;
  }
  planCut(plan);
  if (former) plan.scanned_solid = former->applyTo(plan.patient);
  if (!plan.recording && !options.no_record)
    plan.recording = defaultRecording(plan.patient.site ? plan.patient.site->fdi : 0);
  if (plan.recording) {
    SessionSetup& setup = plan.recording->setup;
    if (options.patient.empty()) setup.built_in = jaw;
    setup.tray = plan.other_tools;
    setup.tray.insert(setup.tray.begin(), plan.command.tool);
    if (former) setup.former = former->setup.former;
  }
  assets::FacePose X_PF = assets::kFaceAxes_PF;
  if (!options.face.empty()) X_PF = replaceFace(plan.patient, options.face);
  plan.face_window_mm = options.face_window_mm.value_or(options.face.empty() ? 0.0 : kForeignFaceWindow_mm);
  placePatient(plan, options, chosen, device, X_PF);
  return rehearse(std::move(plan));
}

}  // namespace

void addRehearse(CommandLine& molar) {
  auto o = std::make_shared<RehearseOptions>();
  CommandLine& command = molar.command("rehearse", "Rehearse a third-molar extraction, seen and felt");
  command.example("molar rehearse", "on the desk, with the mouse, on the built-in patient");
  command.example("molar rehearse --case horizontal --tool round:3.0 --tool fissure:1.6,6 --instructor",
                  "a difficult case with two burs, and the instructor's window beside it");
  command.example("molar rehearse PATIENT --device openhaptics --record first.molar",
                  "an imported patient, with a haptic device, recorded");
  command.optionGroup("Patient");
  Option patient = command.option("PATIENT", o->patient, "Patient folder [the built-in patient]");
  command.flag("--cases", o->list_cases, "List the named cases of the built-in patient, and end");
  Option named = command.option("--case", o->case_name, "Built-in patient: a case by its name, see --cases");
  named.oneOf(caseNames()).excludes(patient);
  const auto built_in = [&](const std::string& name, auto& value, const std::string& help) {
    return command.option(name, value, "Built-in patient: " + help).showsDefault().excludes(patient);
  };
  built_in("--side", o->side, "side of the tooth").oneOf({"right", "left"}).excludes(named);
  built_in(
      "--winter-angle", o->jaw.winter_angle_deg,
      "tilt of the tooth after Winter, degrees: vertical 0, mesio-angular 45, horizontal 90, disto-angular below 0")
      .from(-79.0, 100.0)
      .excludes(named);
  built_in("--depth", o->jaw.depth_mm,
           "top of the crown below the occlusal plane, mm (Pell and Gregory: A about 0, B about 4, C about 8)")
      .from(0.0, 12.0)
      .excludes(named);
  built_in("--canal-distance", o->jaw.mandibular_canal_distance_mm, "root to mandibular canal, mm; 0 touches it")
      .from(0.0, 6.0)
      .excludes(named);
  built_in("--voxel", o->jaw.spacing_mm, "voxel edge, mm").from(0.15, 1.0);
  built_in("--seed", o->jaw.seed, "number that varies its shape");
  command.option("--face", o->face, "Face model, glTF; teeth.json beside it places the jaw").valueNamed("FILE");
  command
      .option("--position", o->position,
              "seated, before the surgeon; or lying, approached from the right (10 o'clock), the left (2 o'clock) or "
              "behind (12 o'clock) [seated, or as the rig states]")
      .oneOf({kPatientPositions.begin(), kPatientPositions.end()});
  command.optionGroup("Hand and instruments");
  command.option("--device", o->plan.device, poseSourceHelp()).showsDefault();
  command.option("--tool", o->tools, headHelp() + "; give several to change between them by key T or pedal")
      .repeated()
      .showsDefault();
  command.option("--shaft", o->shaft, std::string(kShaftHelp) + " [a neck of the head's size, up to 2.35 mm thick]");
  command.option("--pedal", o->pedal, kPedalHelp).showsDefault();
  Option second = command.option("--second-hand", o->plan.second_hand.device, kSecondHandHelp);
  command.option("--second-tool", o->second_tool, "Instrument of the second hand")
      .oneOf(assets::secondInstrumentNames())
      .showsDefault()
      .needs(second);
  command.option("--falcon-firmware", o->falcon_firmware, "Novint's firmware for a Falcon").valueNamed("FILE");
  command.optionGroup("Workplace and picture");
  Option rig = o->rig.addTo(command, true);
  command.option("--loupes", o->loupes, "Magnification on a desk (without --rig)")
      .from(1.0, 8.0)
      .showsDefault()
      .excludes(rig);
  o->display.addTo(command);
  command.option("--monitor", o->monitor, "Monitor, from 1; two windows use the next one as well").wholeFrom(1, 16);
  command.flag("--instructor", o->plan.instructor_window, "Open the instructor's window, on the next monitor if any");
  command.flag("--operator", o->plan.instructor_window, "Former name of --instructor").hidden();
  command.option("--size", o->size, "Image size").valueNamed("WxH");
  o->picture.addTo(command);
  command.option("--face-window", o->face_window_mm, "Face cut away around the line of sight, mm").from(0.0, 100.0);
  command.option("--quality", o->plan.quality_step, "Hold this quality, 0 best, 6 fastest [by measured frame times]")
      .wholeFrom(0, static_cast<int>(render::kQualitySteps.size()) - 1);
  command.flag("--no-line", o->no_line, "Without the line of text in the picture (key L shows it)");
  command.optionGroup("Output");
  Option record =
      command.option("--record", o->record, "Session file to write [a new one in the data folder, see molar sessions]")
          .valueNamed("FILE");
  command.flag("--no-record", o->no_record, "Record nothing").excludes(record);
  command
      .option("--continue", o->continued,
              "Go on where this session ended: its bone, case and tools. last: the newest; undo begins anew")
      .valueNamed("SESSION")
      .excludes(named);
  command.option("--seconds", o->plan.seconds, "End after this time").from(0.1, 86400.0);
  command.option("--snapshot", o->plan.snapshot, "Images at the end: NAME_left.png, NAME_right.png");
  command.option("--first-snapshot", o->plan.first_snapshot, "The same before the first cut");
  command.option("--snapshot-size", o->snapshot_size, "Their size").valueNamed("WxH").showsDefault();
  command.flag("--headless", o->plan.headless, "Without a window");
  command.flag("--force", o->plan.overwrite, "Replace outputs that exist");
  command.optionGroup("For engineers");
  command.flag("--verbose", o->plan.verbose, "Words for engineers on the terminal; keys 1 to 7 choose the force law");
  command.option("--law", o->law, "Force law: " + lawNames()).showsDefault();
  command.option("--erosion", o->erosion, "Erosion law").oneOf(erosionNames()).showsDefault();
  command.option("--set", o->settings,
                 "key=value: stiffness_N_per_mm, peak_force_N, spindle_rpm, worn, removal_rate_per_s, …");
  command
      .option("--parameters", o->plan.parameters,
              "Settings file, TOML, applied whenever it changes (app/options/feel.toml); overrides --law and --set")
      .valueNamed("FILE");
  command.option("--rate", o->plan.rate_Hz, "Servo rate, Hz [1000, or as recorded]").from(500.0, 10'000.0);
  command
      .option("--priority", o->plan.device_options.servo_priority,
              "Real-time priority of the servo; the USB thread has the next")
      .wholeFrom(haptics::kMinServoPriority, haptics::kMaxServoPriority)
      .showsDefault();
  command.option("--pace", o->pace, "real; or fast: simulated input without a window, as fast as the machine can")
      .oneOf({"real", "fast"})
      .showsDefault();
  command.footer(keyHelp());
  command.does([o] { return run(*o); });
}

}  // namespace app
