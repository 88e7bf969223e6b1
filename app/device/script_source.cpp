#include "app/case/treated_tooth.h"
#include "app/device/file_script.h"
#include "app/device/phantom_work_cycle.h"
#include "app/device/pose_sources.h"
#include "app/device/practice_device.h"
#include "app/text/usage_error.h"
#include "haptics/device/simulated/scripted_device.h"

namespace app {
namespace {

/// The cut of a simulated hand on this patient.
const assets::PlannedCut& cutFor(const PoseSourceContext& at) {
  if (!at.cut)
    throw UsageError("--device: no bone of this patient can be reached by a script, use --device replay:SESSION");
  return *at.cut;
}

}  // namespace

haptics::CuttingMotion cuttingMotion(const assets::PlannedCut& cut, const calibration::Rig& rig) {
  if (cut.shaft_P != glm::dvec3(0.0)) return {.shaft_P = cut.shaft_P};
  // Half way between the way into the bone, where the neck has room, and what leaves the site to be seen.
  return {.shaft_P =
              glm::normalize(glm::normalize(cut.outward_P) + glm::conjugate(rig.X_WP.rotation) * shaftDirection_W())};
}

PoseSource openScript(const std::string& rest, const PoseSourceContext& at) {
  PoseSource hand;
  if (rest == kThirdMolarScript || rest == kFlapScript) {
    const haptics::TroughPath gutter(cutFor(at), cuttingMotion(cutFor(at), at.rig));
    auto led = std::make_unique<haptics::LedHand>(gutter.at(0.0));
    hand.led = led.get();
    hand.device = std::move(led);
    hand.name = rest == kFlapScript ? "scripted hand, flap" : "scripted hand, third molar";
    return hand;
  }
  if (at.patient.canals)
    return handAlong(fileScript(*at.patient.canals, !isRoofOpen(*at.patient.canals, at.patient.ct)),
                     "scripted hand, root canals");
  auto scripted = std::make_unique<haptics::ScriptedDevice>(cutFor(at), cuttingMotion(cutFor(at), at.rig));
  hand.duration_s = scripted->duration_s();
  hand.device = std::move(scripted);
  hand.name = "scripted hand";
  return hand;
}

PoseSource openSimulated(const std::string& model, const PoseSourceContext& at) {
  PoseSource hand;
  const haptics::PhantomMechanics& mechanics = *haptics::findSimulatedPhantom(model.empty() ? "omni" : model);
  const haptics::WorkCycle round = workCycleFor(mechanics, cutFor(at), cuttingMotion(cutFor(at), at.rig), at.rig);
  hand.duration_s = round.duration_s();
  hand.X_PD = at.rig.X_WP.inverse() * at.rig.X_WD;
  hand.device = std::make_unique<haptics::SimulatedPhantom>(mechanics, [round](double t_s) { return round.at(t_s); });
  hand.name = "simulated " + std::string(mechanics.name);
  return hand;
}

PoseSource openPractice(const std::string& unit, const PoseSourceContext& at) {
  PoseSource hand;
  const calibration::SyntheticRig truth = practiceRig("practice:" + unit).value();
  const haptics::PhantomMechanics& mechanics = *haptics::findSimulatedPhantom(truth.nominal.device->model);
  calibration::Rig true_rig = at.rig;
  true_rig.X_WD = truth.X_WD;
  const glm::dvec3 tip_H_mm = truth.arm.truth.tip_H_mm;
  const haptics::WorkCycle round =
      workCycleFor(mechanics, cutFor(at), cuttingMotion(cutFor(at), at.rig), true_rig, tip_H_mm);
  hand.duration_s = round.duration_s();
  hand.device =
      std::make_unique<haptics::SimulatedPhantom>(mechanics, handleScript(round, tip_H_mm), haptics::Grip{}, 1,
                                                  haptics::PhantomUnit{truth.nominal.device->serial, truth.arm});
  hand.name = "practice " + std::string(mechanics.name) + ", " + truth.nominal.device->serial;
  standAsMeasured(hand, at.rig);
  return hand;
}

}  // namespace app
