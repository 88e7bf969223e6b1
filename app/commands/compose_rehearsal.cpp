#include "app/commands/compose_rehearsal.h"

#include <algorithm>
#include <cstdlib>
#include <thread>

#include "app/case/fitting_cone.h"
#include "app/case/patient_placement.h"
#include "app/commands/compose_preparation.h"
#include "app/commands/rehearsal_refusals.h"
#include "app/commands/rehearsed_case.h"
#include "app/controls/prediction_question.h"
#include "app/controls/tool_ring.h"
#include "app/device/falcon_scale_file.h"
#include "app/device/pose_source_table.h"
#include "app/options/command_settings.h"
#include "app/options/feel_preset.h"
#include "app/options/law_text.h"
#include "app/options/pedal_option.h"
#include "app/options/tool_text.h"
#include "app/options/view_option.h"
#include "app/procedure/coach/coach_file.h"
#include "app/procedure/steps/step_file.h"
#include "app/procedure/third_molar/demonstration.h"
#include "app/rehearsal/continuation.h"
#include "app/rehearsal/recording_check.h"
#include "app/session/data_folder.h"
#include "app/session/session_error.h"
#include "app/session/session_folder.h"
#include "app/station/case_reach.h"
#include "app/station/patient_list.h"
#include "app/text/list.h"
#include "app/text/message.h"
#include "app/text/usage_error.h"
#include "assets/synthetic/practice_block.h"
#include "calibration/record/utc.h"
#include "haptics/device/device_catalogue.h"

namespace app {
namespace {

constexpr double kForeignFaceWindow_mm = 24.0;
constexpr double kUsualLoupes = 4.0, kPreparationLoupes = 6.0, kMicroscope = 10.0;  ///< magnification on a desk

/// Without a rig: a desktop monitor, its image magnified (--loupes). With one everything is 1:1, and the patient's pose
/// is the rig's, or else has the operated tooth at the origin of W.
calibration::Rig rigFor(const RehearseOptions& options, const std::optional<ChosenRig>& chosen) {
  calibration::Rig rig;
  if (chosen) {
    rig = chosen->record.rig;
    if (!options.size.empty()) rig.screen.px = imageSize(options.size);
  } else {
    const glm::ivec2 default_px = options.plan.headless ? glm::ivec2(640, 400) : glm::ivec2(1280, 800);
    rig = calibration::desktopRig(
        options.size.empty() ? default_px : imageSize(options.size),
        calibration::kDeskMonitorWidth_mm / options.loupes.value_or(isRootCanal(options)     ? kMicroscope
                                                                    : isPreparation(options) ? kPreparationLoupes
                                                                                             : kUsualLoupes));
  }
  if (options.position && !hasNoPatientPose(rig))
    throw UsageError("--position " + *options.position + ": the rig states the pose of the head (X_WP), leave it out");
  return rig;
}

/// Of the canals, below where files are read.
double orificeDepth_mm(const assets::ToothCanals& tooth) {
  const assets::ToothCanal& first = tooth.canals.front();
  return glm::dot(first.reference_P_mm - first.orifice_P_mm(), tooth.frame.axes_P[2]);
}

/// The device is opened first, as a rig belongs to one device and only the device knows its serial number.
std::optional<ChosenRig> chooseRig(RehearsalPlan& plan, const RehearseOptions& options, DeviceIdentity& device) {
  if (haptics::isDeviceAddress(options.plan.device) && !plan.opened)
    plan.opened = haptics::openDevice(options.plan.device, plan.device_options);
  device = deviceIdentity(options.plan.device, plan.opened ? &plan.opened->device->capabilities() : nullptr);
  const bool turns = plan.opened ? plan.opened->device->capabilities().has_orientation : plan.device != "mouse";
  if (plan.opened && !turns)
    plan.remarks.push_back(device.model + ": it measures no orientation, the bur keeps a fixed one, without handpiece");
  // A hand that cannot turn a handpiece out of the way holds the bur alone.
  plan.command.tool.handpiece = turns;
  // The shown operation goes on without handpiece: with an angled one, which is not modelled.
  const bool is_angled = isShown(options);
  for (haptics::Tool& tool : plan.other_tools) tool.handpiece = turns && !is_angled;
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

/// As asked for, else as the rig is set up for, else seated. Throws UsageError for a position that is not known.
std::string positionOf(const RehearseOptions& options, const std::optional<ChosenRig>& chosen,
                       std::vector<std::string>& remarks) {
  const std::string kept = chosen ? chosen->record.patient_position : std::string();
  if (!kept.empty() && std::ranges::find(kPatientPositions, kept) == kPatientPositions.end())
    throw UsageError(chosen->source + ": patient.position '" + kept + "' is not known, give one of " +
                     joined(kPatientPositions));
  if (options.position && !kept.empty() && *options.position != kept)
    remarks.push_back("position " + *options.position + ": hand rest and head of " + chosen->source +
                      " are set up for " + kept);
  return options.position.value_or(kept.empty() ? std::string(kPatientPositions.front()) : kept);
}

void placeInRoom(RehearsalPlan& plan, const std::string& position, const std::optional<ChosenRig>& chosen,
                 const DeviceIdentity& device, const assets::FacePose& X_PF) {
  // On the desktop X_WD is the identity: the tooth is at the origin of D, the middle of a Phantom's workspace.
  if (hasNoPatientPose(plan.rig)) {
    plan.rig.X_WP = placePatientAtSite(plan.patient, X_PF, patientPositionNamed(position));
    plan.down_P = downInRoom(plan.patient, X_PF, patientPositionNamed(position)).xyz;
  }
  if (plan.recording) plan.recording->setup.down_P = plan.gravity_P();
  if (!chosen) return;
  const std::vector<std::string> fit = caseRemarks(plan.rig, plan.patient, chosen->record.eye_sd_mm,
                                                   device.isCalibrated() ? device.model : std::string());
  plan.remarks.insert(plan.remarks.end(), fit.begin(), fit.end());
}

/// Mesa's software renderer would use every core.
void reserveCoreForServo() {
  const unsigned cores = std::thread::hardware_concurrency();
  const std::string threads = std::to_string(cores > 1 ? cores - 1 : 1);
  setenv("LP_NUM_THREADS", threads.c_str(), 0);
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
    makeDataFolder(folder);
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
  if (options.law != kUntouched.law || !options.preset.empty()) plan.command.law = chosen.law;
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

/// A rule of it is about the tooth or the gutter beside it.
bool asksForThirdMolar(const StepPlan& plan) {
  return std::ranges::any_of(plan.steps, [](const Step& step) {
    const DoneWhen& when = step.done_when;
    return when.asksForFlap() || when.gutter_removed || when.crown_bared || when.bridge_mm || when.torn ||
           when.pieces || when.pieces_out || when.all_out;
  });
}

/// What is followed, with what is said, and what is asked of the surgeon.
void chooseProcedure(RehearseOptions& options) {
  RehearsalPlan& plan = options.plan;
  if (options.procedure.empty()) return;
  ProcedureSteps steps;
  steps.plan = stepPlanNamed(options.procedure);
  if (plan.device == "scripted" && options.procedure == "third-molar") plan.device = kShownOperation;
  const auto named = std::ranges::find(kGuidances, std::string_view(options.guidance));
  steps.guidance = named != kGuidances.end() ? static_cast<Guidance>(named - kGuidances.begin())
                   : options.assess          ? Guidance::assessed
                   : isShown(options)        ? Guidance::free
                                             : Guidance::guided;
  if (!options.predict.empty()) {
    const PredictionAnswer answer = predictionAnswerFrom(options.predict);
    steps.prediction.difficulty = answer.difficulty;
    steps.prediction.minutes = answer.minutes;
  }
  steps.asks = options.predict.empty() && !plan.headless && steps.guidance != Guidance::free && !isShown(options);
  plan.procedure_steps = std::move(steps);
}

/// Never in assessment.
void chooseCoach(RehearseOptions& options) {
  const std::optional<ProcedureSteps>& steps = options.plan.procedure_steps;
  const bool is_assessed = options.assess || (steps && steps->guidance == Guidance::assessed);
  if (is_assessed && !options.coach.empty() && options.coach != "off")
    throw UsageError("--coach " + options.coach + ": nothing is said in assessment, leave it out");
  const bool is_guided = steps && steps->guidance == Guidance::guided;
  if (options.coach == "off" || (options.coach.empty() && !is_guided)) return;
  options.plan.coach = coachRulesOf(options.coach == "on" ? "" : options.coach);
}

/// The tray, where nothing was asked for by name: what the procedure or the block needs.
void chooseTools(RehearseOptions& options) {
  static const RehearseOptions kAsked;
  if (options.tools != kAsked.tools) return;
  if (isRootCanal(options)) {
    options.tools = {"round:1.2", "fissure:1.0,4.0"};
    for (const char* const size : {"10", "15", "20", "25", "30", "35", "40"})
      options.tools.push_back(std::string("k-file:") + size + ",25");
    return;
  }
  if (isPreparation(options)) {
    options.tools = preparationTools(options);
    return;
  }
  if (const auto task = practiceOf(options))
    options.tools = *task == assets::PracticeTask::plate ? std::vector<std::string>{"round:3.0", "round:2.0"}
                                                         : std::vector<std::string>{"round:2.0", "round:3.0"};
  // A bur of Lindemann's form divides tooth and bone.
  if (isShown(options))
    options.tools = {
        options.tools.front(), "capsule:1.05,8", "elevator:301", "forceps", "suction", "curette", "bone-file"};
}

/// A turbine; for a root canal with the forces of machining, where nothing else was asked for by name: the long burs of
/// a preparation are stiffer by it than a device holds at 1 kHz.
void chooseHighSpeed(RehearseOptions& options) {
  static const RehearseOptions kAsked;
  haptics::Command& command = options.plan.command;
  // 20 W at 200,000 rpm, stalls at 2 N mm: a high-speed handpiece (data sheets, unverified).
  command.spindle = {200'000.0, 2.0, 300'000.0, 0.1, 0.02, 0.05};
  if (!isRootCanal(options)) return;
  if (options.law == kAsked.law) {
    command.law.kind = haptics::LawKind::machining;
    // As stiff as a small bur may be at 1 kHz.
    command.law.machining.edge_radial_N_per_mm = 0.3;
  }
  if (options.erosion == kAsked.erosion) command.erosion.kind = haptics::ErosionKind::machining;
}

/// Tools, law and erosion of the first command.
void chooseCommand(RehearseOptions& options) {
  RehearsalPlan& plan = options.plan;
  const auto tool_of = [&](const std::string& text) { return toolFrom(text, options.shaft); };
  plan.command.tool = tool_of(options.tools.front());
  if (!plan.command.tool.turns())
    throw UsageError("--tool " + options.tools.front() + ": the first tool is a bur, name one before it");
  for (auto other = options.tools.begin() + 1; other != options.tools.end(); ++other)
    plan.other_tools.push_back(tool_of(*other));
  if (isShown(options)) {
    std::vector<haptics::Tool> tray = plan.other_tools;
    tray.insert(tray.begin(), plan.command.tool);
    operationTray(tray);
  }
  plan.command.erosion.kind = *haptics::erosionOfKey(options.erosion);
  plan.command.law.kind = lawNamed(options.law);
  if (isRootCanal(options) || isPreparation(options)) chooseHighSpeed(options);
  plan.command.wear.law = options.wear == "counters"           ? haptics::WearLaw::counters
                          : options.wear == "counters-helical" ? haptics::WearLaw::counters_helical
                                                               : haptics::WearLaw::wear;
  if (!options.preset.empty()) {
    static const RehearseOptions kAsked;
    if (options.law != kAsked.law)
      throw UsageError("--preset " + options.preset + ": it chooses the force law, leave out --law");
    useFeelPreset(options.preset, plan.command.law);
  }
  applyTo(plan.command, options.settings);
  refuseBeyondServoLimits(plan.command);
  refuseUnlessAdmitted(plan.command);
}

/// Both hands and the foot.
void chooseDevices(RehearseOptions& options) {
  RehearsalPlan& plan = options.plan;
  if (plan.headless && plan.instructor_window)
    throw UsageError(
        "--instructor: its window cannot open in a run without windows, leave out --instructor or --headless");
  if (plan.headless && plan.device == "mouse")
    throw UsageError("--headless: there is no mouse without a window, add --device scripted");
  if (plan.headless && plan.second_hand.device == "mouse")
    throw UsageError(
        "--second-hand mouse: there is no mouse without a window, choose scripted or leave --headless out");
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
}

/// What is seen, heard and told; the files of pictures.
void choosePicture(RehearseOptions& options) {
  RehearsalPlan& plan = options.plan;
  plan.display = options.display.mode();
  plan.head_up_line = !options.no_line;
  plan.sound = !options.no_sound;
  const bool is_assessed =
      plan.is_assessed || (plan.procedure_steps && plan.procedure_steps->guidance == Guidance::assessed);
  plan.shows_clearance = options.clearance.empty() ? !is_assessed : options.clearance == "view";
  plan.sounds_clearance = options.clearance == "sound";
  if (plan.sounds_clearance && (options.no_sound || plan.headless))
    throw UsageError("--clearance sound: there is no sound with --no-sound or --headless, leave one of them out");
  plan.eyes_swapped = options.display.swapped();
  plan.backend = options.picture.backend();
  options.picture.apply(plan.first_frame);
  if (options.monitor) plan.monitor = *options.monitor - 1;
  plan.snapshot_px = imageSize(options.snapshot_size);
  refuseUnlessPng("--snapshot", plan.snapshot, MissingEnding::allowed);
  refuseUnlessPng("--first-snapshot", plan.first_snapshot, MissingEnding::allowed);
  if (!plan.snapshot.empty() && plan.snapshot == plan.first_snapshot)
    throw UsageError("--first-snapshot " + plan.snapshot + ": the same as --snapshot, give another name");
}

/// The former session that it goes on from; none: it begins with the patient.
std::optional<Continuation> chooseFormer(RehearseOptions& options) {
  RehearsalPlan& plan = options.plan;
  std::optional<Continuation> former;
  if (!options.continued.empty()) {
    former = continuationOf(sessionNamed(options.continued));
    goOn(options, *former);
    if (!former->setup.practice.empty()) {
      options.case_name = former->setup.practice;
      refuseUnlessForBlock(options);
      if (const auto* const block = preparationBlockOf(options)) plan.instruction = block->instruction;
      if (const auto task = practiceOf(options)) {
        options.jaw.spacing_mm = former->grid.spacing_mm;
        plan.instruction = assets::textOf(*task).instruction;
      }
    }
    if (former->setup.canals) {
      options.task = "root-canal";
      options.tooth = former->setup.canals->fdi;
      options.access = "open";  // its cavity is as it was left
      refuseUnlessForRootCanal(options);
    }
    if (const auto& prepared = former->setup.prepared) {
      options.task = "preparation";
      options.tooth = prepared->fdi;
      options.ideal = prepared->ideal;
      options.caries = prepared->caries;
      options.given_ideal = prepared->given;
      options.opposing = prepared->opposing;
      options.former_bite = prepared->bite;
      refuseUnlessForPreparation(options);
    }
    plan.drawn = former->drawn;
    if (former->setup.isImported() && options.patient.empty())
      throw UsageError("--continue " + former->path +
                       ": is of an imported patient, name its folder: molar rehearse PATIENT --continue " +
                       options.continued);
  }
  if (!options.drawn.empty()) {
    plan.drawn = drawnPlanOf(sessionNamed(options.drawn));
    if (plan.drawn.isEmpty())
      throw UsageError("--drawn " + options.drawn + ": no line was drawn in it, name another session");
  }
  return former;
}

/// Whoever named no tools finds an elevator, forceps and what cleans a socket beside the burs.
void completeTray(RehearsalPlan& plan) {
  plan.other_tools.push_back(haptics::elevatorTool(haptics::ElevatorKind::straight_301));
  plan.other_tools.push_back(haptics::forcepsTool());
  for (const haptics::HandInstrument kind :
       {haptics::HandInstrument::suction, haptics::HandInstrument::curette, haptics::HandInstrument::bone_file})
    plan.other_tools.push_back(haptics::handInstrumentTool(kind));
}

/// Whoever named no tools finds a cone that fits for each canal, as far as the ring has room, and a hot plugger.
void completeRootTray(RehearsalPlan& plan) {
  std::vector<haptics::Tool>& tray = plan.other_tools;
  const auto has_room = [&] { return tray.size() + 2 < kMostInRing; };
  for (const assets::ToothCanal& canal : plan.patient.canals->canals) {
    const haptics::Tool cone = toolFrom(orderOf(fittingCone(canal)), {});
    if (has_room() && std::ranges::find(tray, cone) == tray.end()) tray.push_back(cone);
  }
  tray.push_back(haptics::handInstrumentTool(haptics::HandInstrument::root_plugger));
}

/// What a recording has to know to be gone on from.
void describeSetup(RehearsalPlan& plan, const RehearseOptions& options, const assets::JawParameters& jaw,
                   const std::optional<Continuation>& former) {
  SessionSetup& setup = plan.recording->setup;
  setup.practice = isOnBlock(options) ? options.case_name : "";
  if (options.patient.empty() && setup.practice.empty()) setup.built_in = jaw;
  setup.tray = plan.other_tools;
  setup.tray.insert(setup.tray.begin(), plan.command.tool);
  if (former) setup.former = former->setup.former;
}

}  // namespace

std::optional<RehearsalPlan> composeRehearsal(RehearseOptions& options) {
  RehearsalPlan& plan = options.plan;
  options.patient = patientNamed(options.patient);
  plan.device = withSessionNamed(plan.device);
  plan.second_hand.device = withSessionNamed(plan.second_hand.device);
  if (plan.device.starts_with("scripted:"))
    throw UsageError("--device " + plan.device + ": give --device scripted --procedure third-molar");
  static const RehearseOptions kUntouched;
  const bool are_tools_named = options.tools != kUntouched.tools;
  const std::optional<assets::PracticeTask> block = practiceOf(options);
  if (const auto* const of = preparationBlockOf(options); of != nullptr && !isRootCanal(options)) {
    options.task = "preparation";
    if (!options.tooth) options.tooth = assets::kPreparationBlockTooth;
    if (options.ideal.empty() && options.caries.empty()) options.ideal = of->ideal;
    plan.instruction = of->instruction;
  }
  if (isRootCanal(options)) refuseUnlessForRootCanal(options);
  if (isPreparation(options)) {
    if (options.ideal.empty()) options.ideal = usualIdeal(options.caries);
    refuseUnlessForPreparation(options);
  }
  if (block) {
    refuseUnlessForBlock(options);
    plan.instruction = assets::textOf(*block).instruction;
  }
  chooseProcedure(options);
  if (options.assess) refuseUnlessAssessable(options);
  plan.is_assessed = options.assess;
  chooseCoach(options);
  chooseTools(options);
  if (options.flap == "closed") {
    if (!options.continued.empty())
      throw UsageError("--flap closed: a rehearsal that goes on begins with the flap raised, leave it out");
    if (plan.device == "scripted") plan.device = kShownFlap;
  }
  chooseCommand(options);
  chooseDevices(options);
  choosePicture(options);
  if (!options.record.empty()) {
    refuseUnlessRecordable(options.record, plan.overwrite, {plan.device, plan.second_hand.device});
    plan.recording = Recording{options.record, plan.overwrite};
  }
  const std::optional<Continuation> former = chooseFormer(options);

  assets::JawParameters jaw = former && former->setup.built_in ? *former->setup.built_in : jawOf(options);
  if (options.opening_mm) jaw.opening_mm = *options.opening_mm;
  DeviceIdentity device;
  const std::optional<ChosenRig> chosen = chooseRig(plan, options, device);
  const std::string position = positionOf(options, chosen, plan.remarks);
  options.display.refuseUnlessFits(plan.rig);
  reserveCoreForServo();
  assets::FacePose X_PF;
  if (!prepareCase(plan, options, jaw, X_PF)) {
    printMessage("left before the patient was ready");
    return {};
  }
  if (plan.procedure_steps && asksForThirdMolar(plan.procedure_steps->plan))
    refuseUnlessThirdMolar(plan, options.procedure);
  // On a desk: with a measured rig hand and tooth are seen as they are.
  if (plan.patient.canals && plan.view_can_turn && !plan.is_assessed)
    plan.first_frame.layers.clear_tooth = plan.first_frame.layers.tip_inset = true;
  if (plan.patient.canals && options.locator != "off")
    plan.locator = options.locator == "exact" ? ApexLocator::Mode::exact : ApexLocator::Mode::real;
  if (plan.patient.canals) refuseTooWide(plan);
  if (plan.patient.canals)
    plan.command.file_reference = {plan.patient.canals->canals.front().reference_P_mm,
                                   plan.patient.canals->frame.axes_P[2], orificeDepth_mm(*plan.patient.canals)};
  if (plan.patient.prepared) planPreparation(plan, preparationBlockOf(options) != nullptr, are_tools_named);
  if (options.cavity == "ready" && plan.patient.prepared) plan.scanned_solid = cutReady(plan.patient);
  // An assistant holds cheek and flap aside.
  plan.shows_whole_operation = isShown(options);
  if (options.flap == "closed") closeFlap(plan);
  if (former) {
    plan.scanned_solid = former->applyTo(plan.patient);
    plan.laid = former->laid;
  }
  if (!options.drawn.empty()) refuseUnlessDrawnHere(options, plan.patient.ct);
  if (!former && !block && !are_tools_named && !isShown(options) && plan.patient.site) completeTray(plan);
  if (!former && !are_tools_named && plan.patient.canals) completeRootTray(plan);
  if (!plan.recording && !options.no_record)
    plan.recording = defaultRecording(plan.patient.site ? plan.patient.site->fdi : 0);
  if (plan.recording) describeSetup(plan, options, jaw, former);
  // Of a single tooth all that was done to it counts.
  if (plan.recording && (plan.patient.prepared || plan.patient.canals)) plan.recording->whole = plan.scanned_solid;
  plan.paper_mm = 0.001 * options.paper_um;
  plan.face_window_mm = options.face_window_mm.value_or(options.face.empty() ? 0.0 : kForeignFaceWindow_mm);
  placeInRoom(plan, position, chosen, device, X_PF);
  return std::move(plan);
}

}  // namespace app
