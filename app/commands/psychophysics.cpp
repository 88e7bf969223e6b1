// `molar psychophysics PROTOCOL.toml --out results.csv`: blind comparison of two stimuli on one bone, by a simulated
// participant or a person at the window. A CSV row after each trial; summary JSON and figure at the end.

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/case/patient_placement.h"
#include "app/commands/command.h"
#include "app/device/pose_source_table.h"
#include "app/options/settings_text.h"
#include "app/psychophysics/probed_bone.h"
#include "app/psychophysics/result_chart.h"
#include "app/psychophysics/summary.h"
#include "app/psychophysics/trial_runner.h"
#include "app/psychophysics/trial_table.h"
#include "app/rehearsal/recording_check.h"
#include "app/rehearsal/rehearsal.h"
#include "app/text/command_line.h"
#include "app/text/message.h"
#include "app/text/usage_error.h"
#include "assets/toml_reader.h"
#include "calibration/output_file.h"
#include "calibration/record/rig_file.h"
#include "haptics/device/device_catalogue.h"

namespace app {
namespace {

struct PsychophysicsOptions {
  std::string protocol, out, observer = "simulated", device = "mouse", rig, record;
  std::uint64_t seed = 1;
  bool force = false, instructor_window = false;
};

/// results.csv and results.json.
std::string withEnding(const std::string& csv, const char* ending) {
  return std::filesystem::path(csv).replace_extension(ending).string();
}

constexpr double kLoupes = 4.0;
constexpr glm::ivec2 kWindow_px{1280, 800};

/// The site in the middle of the screen, seen along the bur, slightly from the side to show depth.
calibration::Rig rigFor(const PsychophysicsOptions& options, const ProbeSite& site) {
  if (!options.rig.empty()) return calibration::readRig(options.rig);
  calibration::Rig rig = calibration::desktopRig(kWindow_px, calibration::kDeskMonitorWidth_mm / kLoupes);
  const glm::dvec3 z = site.outward_P.xyz;
  const glm::dvec3 side =
      glm::normalize(glm::cross(glm::abs(z.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0), z));
  const glm::dvec3 up = glm::cross(z, side);
  rig.X_WP = placePatient(site.surface_P, {glm::normalize(z - 0.5 * up)}, {up});
  return rig;
}

struct AtTheWindow {
  bool complete = false;  ///< every trial was answered
  int answer = 0;         ///< 1 if a recording was requested and is not whole
};

/// At the window, blind, until the last trial or Esc.
AtTheWindow runAtTheWindow(const PsychophysicsOptions& options, const Protocol& protocol, const ProbedBone& bone,
                           Experiment& experiment, const TrialRunner::OnTrial& on_trial) {
  TrialRunner desk(experiment, bone.site, protocol.between_trials_s, on_trial);
  RehearsalPlan plan;
  plan.patient = bone.patient;
  // The view is centred on the probed bone.
  plan.patient.jaw_P_mm = bone.site.surface_P.mm;
  if (plan.patient.site) plan.patient.site->centre_P_mm = bone.site.surface_P.mm;
  plan.rig = rigFor(options, bone.site);
  plan.full_screen = !options.rig.empty();
  plan.command = experiment.commandOf(0);
  plan.rate_Hz = protocol.probe.rate_Hz;
  plan.overwrite = options.force;
  if (!options.record.empty()) plan.recording = Recording{options.record, options.force};
  plan.procedure = &desk;
  // The experiment prints its own.
  plan.summary = false;
  plan.device = options.device;
  plan.device_options.report = printMessage;
  if (haptics::isDeviceAddress(options.device)) plan.opened = haptics::openDevice(options.device, plan.device_options);
  plan.instructor_window = options.instructor_window;
  const int answer = rehearse(std::move(plan));
  return {desk.isOver(), answer};
}

int run(const PsychophysicsOptions& options) {
  if (std::filesystem::path(options.out).extension() != ".csv")
    throw UsageError("--out " + options.out + ": end the name in .csv");
  refuseSameFile(options.out, {options.protocol});
  if (!options.record.empty()) refuseUnlessRecordable(options.record, options.force);
  refuseUnlessPoseSource(options.device);
  if (options.device != "mouse" && options.observer != "keyboard")
    throw UsageError("--device " + options.device + ": the simulated participant uses none, add --observer keyboard");
  const Protocol protocol = protocolFromToml(assets::readSmallFile(options.protocol), options.protocol);
  if (protocol.bone.kind == BoneChoice::Kind::volume) refuseSameFile(options.out, {protocol.bone.path});
  calibration::OutputFile summary(withEnding(options.out, ".json"), options.force);
  calibration::OutputFile figure(withEnding(options.out, ".png"), options.force);
  const ProbedBone bone = probedBone(protocol);
  TrialTable table(options.out, options.force, protocol);

  std::vector<TrialRecord> trials;
  AtTheWindow ended{true, 0};
  std::optional<Experiment> experiment;
  if (options.observer == "keyboard") {
    experiment.emplace(protocol, options.seed);
    ended = runAtTheWindow(options, protocol, bone, *experiment, [&](const TrialRecord& record) {
      table.add(record);
      trials.push_back(record);
    });
  } else {
    const bool shows_progress = isatty(2) != 0;
    haptics::Bodies live(bone.patient.ct.grid, bone.patient.ct.solid, bone.patient.ct.label);
    experiment = runSimulated(protocol, live, bone.site, options.seed,
                              [&](const TrialRecord& record, const Experiment& running) {
                                table.add(record);
                                trials.push_back(record);
                                if (shows_progress)
                                  std::fprintf(stderr, "\rtrial %d of at most %d ", record.trial, running.most());
                              });
    if (shows_progress) std::fputc('\n', stderr);
  }
  const Outcome outcome = outcomeOf(protocol, *experiment, std::move(trials), ended.complete, options.seed);
  summary.commit(summaryJson(protocol, outcome, options.seed, options.observer));
  if (!outcome.trials.empty()) drawChart(chartOf(protocol, outcome), figure);
  std::fputs(outcomeText(protocol, outcome).c_str(), stderr);
  return ended.answer;
}

}  // namespace

void addPsychophysics(CommandLine& molar) {
  auto options = std::make_shared<PsychophysicsOptions>();
  CommandLine& command =
      molar.command("psychophysics", "Which of two feels harder? Blind comparisons by protocol: CSV, JSON");
  command.option("PROTOCOL", options->protocol, "Experiment, TOML (app/psychophysics/example.toml)").required();
  command.option("--out", options->out, "A row a trial, .csv; summary and figure next to it as .json, .png").required();
  command.option("--observer", options->observer, "Who answers: simulated, or a person at the window by keyboard")
      .oneOf({"simulated", "keyboard"})
      .showsDefault();
  command.option("--device", options->device, "keyboard: " + poseSourceHelp()).showsDefault();
  command.option("--seed", options->seed, "Of order, hand and observer").showsDefault();
  command.option("--rig", options->rig, "keyboard: rig file, 1:1").valueNamed("FILE");
  command.option("--record", options->record, "keyboard: session file to write").valueNamed("FILE");
  command.flag("--instructor", options->instructor_window,
               "keyboard: open the instructor's window, on the next monitor if any");
  command.flag("--operator", options->instructor_window, "Former name of --instructor").hidden();
  command.flag("--force", options->force, "Replace outputs that exist");
  command.does([options] { return run(*options); });
}

}  // namespace app
