#include "app/hand_at_work.h"

#include "app/phantom_at_work.h"
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

const haptics::PhantomMechanics& simulated(Hand kind) {
  return *haptics::findSimulatedPhantom(kind == Hand::touch     ? "touch"
                                        : kind == Hand::desktop ? "desktop"
                                        : kind == Hand::premium ? "premium"
                                                                : "omni");
}

}  // namespace

Pose<World, Tool> restingTool() { return {glm::dquat(glm::dvec3(0, 0, 1), shaftDirection_W()), {0.0, 6.0, 12.0}}; }

HandAtWork handAtWork(Hand kind, const assets::Patient& patient, const calibration::Rig& rig, double bur_radius_mm) {
  HandAtWork hand;
  if (kind != Hand::mouse) {
    auto trough = planBuccalTrough(patient, bur_radius_mm);
    if (!trough) throw UsageError("--device: this patient has no third molar with bone beside it, use --device mouse");
    trough->shaft_D = {glm::conjugate(rig.X_WP.rotation) * shaftDirection_W()};
    if (kind != Hand::scripted) {
      const haptics::PhantomMechanics& mechanics = simulated(kind);
      const haptics::WorkRound round = roundAtWork(mechanics, *trough, rig);
      hand.duration_s = round.duration_s();
      hand.X_PD = rig.X_WP.inverse() * rig.X_WD;
      hand.device =
          std::make_unique<haptics::SimulatedPhantom>(mechanics, [round](double t_s) { return round.at(t_s); });
      return hand;
    }
    auto scripted = std::make_unique<haptics::ScriptedHand>(*trough);
    hand.duration_s = scripted->duration_s();
    hand.device = std::move(scripted);
    return hand;
  }
  // The mouse moves in W.
  const Pose<World, Tool> X_WT = restingTool();
  auto mouse =
      std::make_unique<haptics::MouseDevice>(haptics::MouseTarget{{X_WT.rotation, X_WT.translation_mm}, false});
  hand.mouse = mouse.get();
  hand.device = std::move(mouse);
  const Pose<World, Patient> X_WP = rig.X_WP;
  hand.X_PD = {X_WP.inverse().rotation, X_WP.inverse().translation_mm};
  return hand;
}

}  // namespace app
