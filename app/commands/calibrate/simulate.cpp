// `molar calibrate simulate`: touches on a workstation whose truth is known, to try everything without one.

#include <memory>

#include "app/commands/calibrate/calibrate.h"
#include "app/text/command_line.h"
#include "app/text/usage_error.h"
#include "calibration/fit/touches_file.h"
#include "calibration/output_file.h"
#include "calibration/record/rig_file.h"
#include "calibration/synthetic/synthetic_rig.h"

namespace app {
namespace {

using namespace calibration;

constexpr glm::dvec3 kHeldOutHalf_mm{65.0, 45.0, 30.0};

struct SimulateOptions {
  std::string scenario = "D", method = "jig27", out, held_out, rig;
  std::uint32_t seed = 1;
  int held_out_n = 16;
  double outliers = 0.0, drift_deg = 0.0, drift_mm = 0.0;
  std::vector<double> bur_mm{0.0, 0.0, 0.0};
  bool force = false;
};

int simulate(const SimulateOptions& options) {
  const auto plan = targetPlan(options.method);
  if (!plan)
    throw UsageError("--method " + options.method +
                     ": not a procedure, choose jig27, jig8, visual15, visual25, rezero5, check4, verify8 or pivot12");
  calibration::OutputFile out(options.out, options.force);
  std::unique_ptr<calibration::OutputFile> held_out, rig_out;
  if (!options.held_out.empty()) held_out = std::make_unique<calibration::OutputFile>(options.held_out, options.force);
  if (!options.rig.empty()) rig_out = std::make_unique<calibration::OutputFile>(options.rig, options.force);

  SyntheticRig rig = syntheticRig(*scenarioNamed(options.scenario), options.seed);
  rig.technician.outlier_share = options.outliers;
  std::mt19937 rng(options.seed);
  if (options.drift_deg > 0.0 || options.drift_mm > 0.0) rig = drifted(rig, options.drift_deg, options.drift_mm, rng);
  rig.arm.truth.tip_H_mm += glm::dvec3(options.bur_mm[0], options.bur_mm[1], options.bur_mm[2]);
  TouchSet touches = simulatedTouches(rig, *plan, rng);
  touches.serial = rig.nominal.device->serial;
  touches.mount = rig.nominal.device->mount;
  touches.method = plan->method;
  if (held_out) {
    TouchSet judges = touches;
    judges.method = "held-out";
    judges.touches = heldOutTouches(rig, options.held_out_n, kHeldOutHalf_mm, rng);
    held_out->commit(touchesText(judges));
  }
  if (rig_out) rig_out->commit(rigText(rig.nominal));
  out.commit(touchesText(touches));
  return 0;
}

}  // namespace

void addCalibrateSimulate(CommandLine& calibrate) {
  auto o = std::make_shared<SimulateOptions>();
  CommandLine& command =
      calibrate.command("simulate", "Touches on a workstation whose truth is known, by scenario and seed");
  command
      .option("--scenario", o->scenario,
              "A good unit, B typical, C bad, D typical with what no correction can express, E held one way, F "
              "touched by eye, G badly modelled")
      .oneOf({"A", "B", "C", "D", "E", "F", "G"})
      .showsDefault();
  command.option("--seed", o->seed, "Which unit").showsDefault();
  command
      .option("--method", o->method,
              "Procedure: jig27, jig8, visual15, visual25, rezero5, check4, verify8; pivot12: a bur in one pit")
      .showsDefault();
  command.option("--outliers", o->outliers, "Share of touches that are off by 5 to 20 mm")
      .from(0.0, 0.5)
      .showsDefault();
  command.option("--drift-deg", o->drift_deg, "Joint offsets since the unit was calibrated, one sigma, degrees")
      .from(0.0, 5.0);
  command.option("--drift-mm", o->drift_mm, "How far its base was pushed since, one sigma an axis, mm").from(0.0, 50.0);
  command.option("--bur-mm", o->bur_mm, "How far the tip of the bur now in it is from the former one, x,y,z in H, mm")
      .numbers(3)
      .from(-100.0, 100.0);
  command.option("--out", o->out, "Observations to write, YAML").valueNamed("FILE").required();
  command.option("--held-out", o->held_out, "Held-out touches to write, with other tilts, YAML").valueNamed("FILE");
  command.option("--held-out-n", o->held_out_n, "How many of these").wholeFrom(4, 1000).showsDefault();
  command.option("--rig", o->rig, "The nominal rig to write, YAML").valueNamed("FILE");
  command.flag("--force", o->force, "Replace files that exist");
  command.does([o] { return simulate(*o); });
}

}  // namespace app
