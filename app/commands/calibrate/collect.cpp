// `molar calibrate collect`: guide a technician through a calibration at the workstation, from homing to sign-off.

#include <cstdio>
#include <memory>

#include "app/calibrate/calibration_text.h"
#include "app/commands/calibrate/calibrate.h"
#include "app/text/command_line.h"
#include "app/text/usage_error.h"
#include "calibration/fit/touches_file.h"
#include "calibration/geometry/units.h"
#include "calibration/output_file.h"

namespace app {
namespace {

using namespace calibration;

struct CollectOptions {
  std::string method = "jig27", rig, observations;
  std::vector<double> jig{0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  std::vector<std::vector<double>> rest_marks;
  WizardOption wizard;
  MeasurementInfo info;
  KeepOption keep;
};

/// Three mm and three degrees, about x, then y, then z.
JigPose jigPose(const std::vector<double>& numbers) {
  const glm::dvec3 turned{radFromDegrees(numbers[3]), radFromDegrees(numbers[4]), radFromDegrees(numbers[5])};
  return {{glm::dquat(turned), {numbers[0], numbers[1], numbers[2]}}};
}

int collectByWebcam(const CollectOptions& options, calibration::OutputFile* observations) {
  const auto [before, seen, info] = options.wizard.guideWebcam(options.rig, options.keep.rigs(), options.info);
  if (!seen) {
    std::fputs("molar: left before the end: nothing is changed\n", stderr);
    return 1;
  }
  if (observations != nullptr) observations->commit(webcamFileText(*seen));
  return conclude(*seen, fitWebcam(*seen), before, info, options.keep);
}

int collect(const CollectOptions& asked) {
  CollectOptions options = asked;
  const bool rest = options.method == "rest";
  const bool webcam = options.method == "webcam3";
  const bool touches = options.method.starts_with("jig") || options.method.starts_with("visual");
  if (!rest && !webcam && !(touches && targetPlan(options.method)))
    throw UsageError("--method " + options.method +
                     ": not a procedure, choose jig27, jig8, visual15, visual25, webcam3 or rest");
  if (rest && options.rest_marks.size() < 6)
    throw UsageError("--method rest: it needs six marks, three for the pose and three to verify it: --rest-mark x,y,z");
  for (const auto& mark : options.rest_marks) options.wizard.rest_marks_mm.emplace_back(mark[0], mark[1], mark[2]);
  options.wizard.jig = jigPose(options.jig);
  options.keep.refuseUnlessWritable();
  std::unique_ptr<calibration::OutputFile> observations;
  if (!options.observations.empty())
    observations = std::make_unique<calibration::OutputFile>(options.observations, options.keep.force);

  if (webcam) return collectByWebcam(options, observations.get());
  const WizardOption::GuidedOutcome led =
      options.wizard.guide(rest ? CalibrationProcedure::rest : CalibrationProcedure::full, options.method, options.rig,
                           options.keep.rigs(), options.info);
  if (observations && !led.outcome.touches.touches.empty()) observations->commit(touchesText(led.outcome.touches));
  return conclude(led, options.keep);
}

}  // namespace

void addCalibrateCollect(CommandLine& calibrate) {
  auto o = std::make_shared<CollectOptions>();
  CommandLine& command = calibrate.command(
      "collect", "Lead a technician through a calibration at the workstation, by the stylus and its button alone");
  o->wizard.addTo(command).required();
  o->wizard.addCameraTo(command);
  command
      .option("--method", o->method,
              "jig27 or jig8: a block with pits; visual15 or visual25: nothing but eyes; webcam3: a webcam at "
              "three places; rest: where the hand rests")
      .showsDefault();
  command.option("--rig", o->rig, std::string(kBaseRigHelp) + " [the one in force of this device, else mirrored]");
  command.option("--jig", o->jig, "Where the block stands in W: x,y,z mm and its turns about x, y, z in degrees")
      .numbers(6)
      .from(-1000.0, 1000.0);
  command.option("--rest-mark", o->rest_marks, "A mark of the hand rest in its own frame, x,y,z mm; six of them")
      .numbers(3)
      .from(-1000.0, 1000.0);
  command.option("--observations", o->observations, "The touches as a file as well, to fit again").valueNamed("FILE");
  addMeasurementInfo(command, o->info);
  o->keep.addTo(command);
  command.does([o] { return collect(*o); });
}

}  // namespace app
