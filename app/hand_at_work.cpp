#include "app/hand_at_work.h"

#include <algorithm>

#include "app/phantom_at_work.h"
#include "app/practice_device.h"
#include "app/recorded_hand.h"
#include "app/trough_plan.h"
#include "app/usage_error.h"
#include "haptics/device/simulated/scripted_hand.h"

namespace app {
namespace {

using calibration::Patient;
using calibration::Pose;
using calibration::Tool;
using calibration::World;

/// From the bur to the handle, W: towards the viewer and down over the lower lip, so that it does not hide the site.
glm::dvec3 shaftDirection_W() { return glm::normalize(glm::dvec3(0.12, -0.38, 0.92)); }

/// Where a Phantom stands and how it holds the tool: as measured, or as its model has it.
void standAsMeasured(HandAtWork& hand, const calibration::Rig& rig) {
  hand.X_PD = rig.X_WP.inverse() * rig.X_WD;
  hand.arm = calibration::measuredArm(rig);
  hand.X_HT.translation_mm = hand.arm ? hand.arm->correction.tip_H_mm : calibration::kNominalTip_H_mm;
}

HandAtWork mouseAtWork(const calibration::Rig& rig) {
  HandAtWork hand;
  const Pose<World, Tool> X_WT = restingTool();
  auto mouse =
      std::make_unique<haptics::MouseDevice>(haptics::MouseTarget{{X_WT.rotation, X_WT.translation_mm}, false});
  hand.mouse = mouse.get();
  hand.device = std::move(mouse);
  // The mouse moves in W.
  const Pose<Patient, World> X_PW = rig.X_WP.inverse();
  hand.X_PD = {X_PW.rotation, X_PW.translation_mm};
  return hand;
}

haptics::TroughPlan troughFor(const assets::Patient& patient, const calibration::Rig& rig, double bur_radius_mm) {
  auto trough = planBuccalTrough(patient, bur_radius_mm);
  if (!trough) throw UsageError("--device: this patient has no third molar with bone beside it, use --device mouse");
  trough->shaft_D = {glm::conjugate(rig.X_WP.rotation) * shaftDirection_W()};
  return *trough;
}

HandAtWork scriptAtWork(const std::string& phantom, const assets::Patient& patient, const calibration::Rig& rig,
                        double bur_radius_mm) {
  HandAtWork hand;
  const haptics::TroughPlan trough = troughFor(patient, rig, bur_radius_mm);
  if (phantom.empty()) {
    auto scripted = std::make_unique<haptics::ScriptedHand>(trough);
    hand.duration_s = scripted->duration_s();
    hand.device = std::move(scripted);
    return hand;
  }
  const haptics::PhantomMechanics& mechanics = *haptics::findSimulatedPhantom(phantom);
  const haptics::WorkRound round = roundAtWork(mechanics, trough, rig);
  hand.duration_s = round.duration_s();
  hand.X_PD = rig.X_WP.inverse() * rig.X_WD;
  hand.device = std::make_unique<haptics::SimulatedPhantom>(mechanics, [round](double t_s) { return round.at(t_s); });
  return hand;
}

/// The hand works where the site truly is; what Molar makes of it is the rig's to say.
HandAtWork practiceAtWork(const calibration::SyntheticRig& truth, const assets::Patient& patient,
                          const calibration::Rig& rig, double bur_radius_mm) {
  HandAtWork hand;
  const haptics::PhantomMechanics& mechanics = *haptics::findSimulatedPhantom(truth.nominal.device->model);
  calibration::Rig true_rig = rig;
  true_rig.X_WD = truth.X_WD;
  const glm::dvec3 tip_H_mm = truth.arm.truth.tip_H_mm;
  const haptics::WorkRound round = roundAtWork(mechanics, troughFor(patient, rig, bur_radius_mm), true_rig, tip_H_mm);
  hand.duration_s = round.duration_s();
  hand.device =
      std::make_unique<haptics::SimulatedPhantom>(mechanics, handleOf(round, tip_H_mm), haptics::Grip{}, 1,
                                                  haptics::PhantomUnit{truth.nominal.device->serial, truth.arm});
  hand.name = "practice " + std::string(mechanics.name) + ", " + truth.nominal.device->serial;
  standAsMeasured(hand, rig);
  return hand;
}

HandAtWork replayAtWork(const std::string& session) {
  HandAtWork hand;
  auto recorded = recordedHand(session);
  hand.duration_s = recorded->duration_s();
  hand.rate_Hz = recorded->rate_Hz();
  hand.device = std::move(recorded);
  return hand;
}

HandAtWork deviceAtWork(OpenedDevice opened, const calibration::Rig& rig) {
  HandAtWork hand;
  hand.library = std::move(opened.library);
  hand.device = std::move(opened.device);
  if (hand.library)
    standAsMeasured(hand, rig);
  else
    hand.X_PD = rig.X_WP.inverse() * rig.X_WD;
  return hand;
}

}  // namespace

Pose<World, Tool> restingTool() { return {glm::dquat(glm::dvec3(0, 0, 1), shaftDirection_W()), {0.0, 6.0, 12.0}}; }

HandAtWork handAtWork(const std::string& address, const DeviceOptions& options, const assets::Patient& patient,
                      const calibration::Rig& rig, double bur_radius_mm, std::optional<OpenedDevice> opened) {
  constexpr std::string_view kSimulated = "simulated:", kReplay = "replay:";
  const auto known = std::ranges::find(kHands, address, &HandName::key);
  HandAtWork hand;
  if (address == "mouse") {
    hand = mouseAtWork(rig);
  } else if (known != kHands.end()) {
    const std::string phantom = address == "scripted"             ? ""
                                : address.starts_with(kSimulated) ? address.substr(kSimulated.size())
                                                                  : "omni";
    hand = scriptAtWork(phantom, patient, rig, bur_radius_mm);
  } else if (address.starts_with(kReplay)) {
    hand = replayAtWork(address.substr(kReplay.size()));
  } else if (const auto practice = practiceRig(address)) {
    hand = practiceAtWork(*practice, patient, rig, bur_radius_mm);
  } else {
    hand = deviceAtWork(opened ? std::move(*opened) : openDevice(address, options), rig);
  }
  if (hand.name.empty())
    hand.name = known != kHands.end() ? std::string(known->name) : hand.device->capabilities().model;
  return hand;
}

}  // namespace app
