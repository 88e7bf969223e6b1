#include "haptics/servo/servo.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "haptics/contact/law_parameters.h"
#include "haptics/contact/overlap.h"

namespace haptics {
Command sanitised(const Command& command) {
  Command safe = command;
  safe.tool = sanitised(command.tool);
  safe.law = sanitised(command.law);
  safe.erosion = sanitised(command.erosion);
  safe.spindle = sanitised(command.spindle);
  safe.wear = sanitised(command.wear);
  safe.file_reference = sanitised(command.file_reference);
  safe.safety = sanitised(command.safety);
  return safe;
}

/// Soft tissue that does not hold the tool off: what the assistant holds aside, with a flap the wound's edge, and gum
/// under blade and periosteal elevator, which cut it and lift it.
static std::uint8_t givingWay(const Command& command) noexcept {
  using assets::SoftTissue;
  std::uint8_t tissues = 0;
  if (command.assistant_holds)
    tissues = static_cast<std::uint8_t>(bitOf(SoftTissue::lip) | bitOf(SoftTissue::cheek) | bitOf(SoftTissue::tongue) |
                                        bitOf(SoftTissue::mucosa));
  if (command.flap_aside)
    tissues = static_cast<std::uint8_t>(tissues | bitOf(SoftTissue::flap) | bitOf(SoftTissue::gingiva));
  const HandInstrument in_hand = command.tool.hand_instrument;
  if (in_hand == HandInstrument::scalpel_15 || in_hand == HandInstrument::periosteal)
    tissues = static_cast<std::uint8_t>(tissues | bitOf(SoftTissue::gingiva) | bitOf(SoftTissue::flap));
  return tissues;
}

Tick Servo::step(const HandSample& hand, const Command& requested, double dt_s) noexcept {
  const Command command = sanitised(requested);
  Tick tick;
  tick.index = next_index_++;
  tick.dt_s = std::isfinite(dt_s) ? std::clamp(dt_s, 1e-6, 0.02) : 1e-3;
  tick.t_s = t_s_;
  t_s_ += tick.dt_s;
  tick.command_serial = command.serial;
  tick.hand = hand;

  // The hand, or its last valid pose.
  HandSample sensed = hand;
  sensed.held = hand.held && !command.hands_off;
  const SafetyLayer::Admitted admitted = safety_.admit(sensed, command.safety, command.rearm, tick.dt_s);
  const HandSample& valid = admitted.hand;
  // Without force the proxy follows the hand.
  if (admitted.relocated || (command.safety.must_be_armed && admitted.state != SafetyState::active)) {
    proxy_.release();
    soft_hold_.release();
  }
  // What was asked for is no trouble.
  tick.faults = command.hands_off ? without(admitted.faults, Fault::let_go) : admitted.faults;
  tick.state = admitted.state;

  // Undo before the bone is evaluated.
  split_.receive(bodies_, command.split);
  breaks_.receive(bodies_, command.bridge);
  chips_.receive(bodies_, command.chips);
  if (sites_.isNew(command.site))
    sites_.receive(bodies_, command.site, luxation_.holds(), undo_.leftByLuxation(command.site.piece));
  const StrokeUndo::Serials serials{command.undo_serial, command.redo_serial};
  double restored_mm3 = 0.0;
  if (luxation_.holds())
    undo_.ignore(serials);
  else if (!split_.isRunning() && !chips_.isRunning())
    restored_mm3 = undo_.restore(bodies_, sites_, serials, command.tool, at_proxy_X_PT_);
  if (undo_.hasMovedPieces()) luxation_.lookAgain(bodies_, sites_);
  const bool embedded = undo_.isToolEmbedded(), was_undone = embedded || undo_.hasChanged();

  // The pedal turns the bur. In an invalid state the pedal counts as proxy.
  // A pedal that was down when bur, forceps, elevator or hand instrument changed, or at an undo, or with the hands off,
  // must be released.
  const Tool before = std::exchange(tool_before_, command.tool);
  const bool changed = before.grips != command.tool.grips || before.isElevator() != command.tool.isElevator() ||
                       before.isHandInstrument() != command.tool.isHandInstrument() || before.file != command.tool.file;
  pedal_spent_ =
      valid.drill_pedal && (pedal_spent_ || changed || command.hands_off || (was_undone && command.tool.luxates()));
  const bool pedal = valid.drill_pedal && !pedal_spent_;
  const bool foot = pedal && command.drill_enabled && command.tool.turns();
  tick.drill_inhibit = undo_.inhibitFor((valid.drill_pedal && command.drill_enabled) || !admitted.mayDrill());
  tick.drilling = foot && admitted.mayDrill() && tick.drill_inhibit == DrillInhibit::none;
  cutting_.turn(command.spindle, tick.drilling, tick.dt_s);
  tick.spindle_rad_per_s = cutting_.spindle().rad_per_s;

  // Soft tissue holds the tool off; bone contact starts from there.
  const SoftHold::State soft = soft_hold_.update(soft_tissue_, command.tool, valid.X_PT, valid.velocity_P_mm_per_s,
                                                 tick.drilling, givingWay(command));
  tick.soft = soft.touch;

  // Forceps are led by the piece they hold, an elevator by what its blade meets.
  const Luxation::Hand luxating{soft.X_PT, pedal, admitted.mayDrill() && !embedded};
  const bool led_before = luxation_.leads();
  if (const auto piece = luxation_.reach(bodies_, sites_, command.tool, luxating))
    undo_.beginLuxation(bodies_, sites_, *piece);
  luxation_.move(bodies_, sites_, command.tool, luxating, tick.dt_s);

  // Contact at the proxy.
  const ToolMotion motion = cutting_.motion(valid.velocity_P_mm_per_s, tick.dt_s);
  const SolidBodies bodies = metBy(command.tool, bodies_);
  Proxy::State proxy;
  RootCanalFile::Felt filed;
  const bool holds_file = command.tool.isFile();
  canal_file_.followStrokes(undo_.strokes(), undo_.hasChanged());
  if (!holds_file) {
    canal_file_.putDown(tick.dt_s, command.irrigating);
    tick.file = canal_file_.work();
  }
  if (holds_file) {
    const bool without_force = command.safety.must_be_armed && admitted.state != SafetyState::active;
    filed = canal_file_.update(
        bodies_, undo_.strokes(), command.tool, command.file_reference, command.wear,
        {soft.X_PT, pedal, admitted.relocated || without_force || undo_.hasChanged(),
         admitted.mayDrill() && !was_undone, command.irrigating, command.safety.max_stiffness_N_per_mm},
        tick.dt_s, tick.index);
    proxy.proxy_P = filed.handle_P;
    at_proxy_X_PT_ = {soft.X_PT.rotation, filed.handle_P.mm};
    proxy_.startAt(filed.handle_P);
    tick.file = canal_file_.work();
    tick.unsettled = tick.file.unsettled;
  } else if (!luxation_.leads()) {
    proxy = embedded ? proxy_.passThrough(bodies, command.law, command.tool, soft.X_PT, motion)
                     : proxy_.update(bodies, command.law, command.tool, soft.X_PT, motion,
                                     command.safety.max_stiffness_N_per_mm);
    if (embedded && !proxy.touches()) undo_.release();
    at_proxy_X_PT_ = {soft.X_PT.rotation, proxy.proxy_P.mm};
    if (!led_before && luxation_.takeHold(bodies_, sites_, command.tool, at_proxy_X_PT_, luxating)) {
      if (luxation_.holds()) undo_.beginLuxation(bodies_, sites_, luxation_.led().piece);
      luxation_.move(bodies_, sites_, command.tool, luxating, tick.dt_s);
    }
  }
  const LedTool& led = luxation_.led();
  tick.unsettled = sites_.settle(bodies_, tick.dt_s) || led.unsettled || tick.unsettled;
  if (!led.holds && !sites_.areSettling()) undo_.endLuxation(bodies_, sites_);
  if (led.leads) {
    at_proxy_X_PT_ = led.X_PT;
    proxy = {};
    proxy.proxy_P.mm = led.X_PT.translation_mm;
    proxy_.startAt(proxy.proxy_P);
    tick.soft.turn_P = led.X_PT.rotation * glm::conjugate(valid.X_PT.rotation);
  }
  tick.proxy_P = proxy.proxy_P;
  tick.overlap_mm3 = proxy.head.volume_mm3;
  tick.depth_mm = proxy.head.depth_mm;
  tick.contact_tissue =
      proxy.head.depth_mm > 0.0 ? dominantLabel(bodies, proxy.proxy_P, command.tool.head.radius_mm) : std::uint8_t{0};

  // The law's wrench, then the commanded one.
  tick.law_force_P_N = proxy.force_P_N() + dampingForce_N(command.law, proxy.touching(), valid.velocity_P_mm_per_s);
  tick.law_torque_P_Nmm = proxy.torque_P_Nmm();
  if (led.leads) {
    tick.law_force_P_N = led.felt.force_N;
    tick.law_torque_P_Nmm = led.felt.torque_Nmm;
    tick.grip_force_P_N = led.gripped.force_N;
    tick.grip_torque_P_Nmm = led.gripped.torque_Nmm;
    tick.gripped = command.tool.grips ? static_cast<std::uint8_t>(led.piece + 1) : std::uint8_t{0};
  }
  if (holds_file) {
    tick.law_force_P_N = filed.on_hand.force_N;
    tick.law_torque_P_Nmm = filed.on_hand.torque_Nmm;
  }
  tick.lever = led.lever;
  tick.set_aside = led.set_aside;
  tick.torn_share = led.torn_share;
  tick.torn_total_Nmm = sites_.tornTotal_Nmm();
  // A device without torque feels what tears as pulses.
  calibration::Vector<calibration::Patient> vibration_P_N = proxy.head.vibration_P_N;
  const double torn_Nmm = led.holds ? tick.torn_total_Nmm - torn_before_Nmm_ : 0.0;
  torn_before_Nmm_ = tick.torn_total_Nmm;
  if (!(command.safety.peak_torque_Nmm > 0.0))
    vibration_P_N.xyz +=
        pulses_.update(torn_Nmm, broke_, at_proxy_X_PT_.rotation * glm::dvec3(0.0, 0.0, 1.0), tick.dt_s).xyz;
  if (!(command.safety.peak_torque_Nmm > 0.0)) vibration_P_N.xyz += filed.vibration_P_N.xyz;
  broke_ = false;
  const SafetyLayer::Request law{
      {tick.law_force_P_N + tick.soft.force_P_N, tick.law_torque_P_Nmm + tick.soft.torque_P_Nmm},
      vibration_P_N,
      {},
      proxy.maxStored_Nmm() + soft.max_stored_Nmm + led.max_stored_Nmm + filed.max_stored_Nmm,
      proxy.touches() || led.leads || filed.touches};
  const Delivery::Changes changes{
      command.serial != last_serial_ || embedded != was_embedded_ || led.leads != was_led_ || undo_.hasMovedPieces(),
      admitted.relocated};
  last_serial_ = command.serial;
  was_led_ = led.leads;
  was_embedded_ = embedded;
  const SafetyFilter::Delivered delivered = delivery_.deliver(law, changes, valid, safety_, command.safety, tick.dt_s);
  tick.commanded_force_P_N = delivered.wrench_P.force_N;
  tick.commanded_torque_P_Nmm = delivered.wrench_P.torque_Nmm;
  tick.energy_Nmm = safety_.energy_Nmm();
  tick.faults = tick.faults | delivered.faults;

  // Bur or file cut at the proxy. In a socket that changes nothing goes on settling.
  const Cutting::Engagement at{at_proxy_X_PT_, command.tool.head, embedded ? Contact{} : proxy.head, proxy.force_P_N()};
  const bool files =
      command.tool.hand_instrument == HandInstrument::bone_file && admitted.mayDrill() && !embedded && !was_undone;
  const bool cuts = (tick.drilling || files) && proxy.head.volume_mm3 > 0.0;
  if (cuts) undo_.endLuxation(bodies_, sites_);
  CarveResult removed = cutting_.cut(bodies_, undo_.strokes(), command.erosion, command.spindle, command.law, at,
                                     tick.drilling, tick.dt_s, tick.index);
  removed += filing_.file(bodies_, undo_.strokes(), {at.X_PT, at.head, at.contact, at.force_P_N}, files, tick.dt_s,
                          tick.index);
  removed += filed.removed;
  if (undo_.hasChanged()) filling_.stopCone();
  if (filed.let_go) filling_.lay(*filed.let_go);
  tick.filling = filling_.work(
      bodies_, undo_.strokes(), command.tool, at_proxy_X_PT_,
      pedal && command.drill_enabled && admitted.mayDrill() && tick.drill_inhibit == DrillInhibit::none && !was_undone,
      command.erosion, tick.dt_s, tick.index);
  const double worked_mm3 = std::max(std::abs(tick.filling.changed_mm3), tick.filling.packed_mm3);
  undo_.update(cuts || filed.files || tick.filling.works, proxy.proxy_P, removed.removed_mm3 + worked_mm3,
               !split_.isRunning() && !chips_.isRunning() && !filling_.isLayingCone(), tick.dt_s);
  tick.removed_mm3 = removed.removed_mm3 - restored_mm3;

  // The bridge of the piece that is twisted or wedged breaks: the tool leads alone until its parts are ready.
  breaks_.reset();
  if (tick.gripped != 0 && !split_.isRunning())
    breaks_.grip(bodies_, led.piece, led.gripped, {led.X_PT.translation_mm});
  if (led.lever.piece != 0 && !split_.isRunning()) breaks_.wedge(bodies_, led.piece, led.lever.wedging_N);
  tick.bridge_share = breaks_.share();
  tick.broken = breaks_.broken();
  if (const std::size_t broken = breaks_.broken().piece; broken != 0) {
    undo_.endLuxation(bodies_, sites_);
    luxation_.drop();
    broke_ = true;
    split_.breakOff(bodies_, broken - 1, breaks_.planOf(broken - 1), undo_.strokes());
  }

  // A piece that has fallen apart becomes two, and chips come loose.
  const bool clear = !proxy.touches() && !led.holds && !embedded && !undo_.isRunning() && !undo_.isLuxating();
  const bool parts = split_.step(bodies_, clear && !chips_.isRunning(), undo_.strokes());
  if (!split_.isRunning()) tick.removed_mm3 += chips_.step(bodies_, clear, undo_.strokes());
  if (parts || chips_.hasChanged()) undo_.keepStrokes();
  if (const auto begun = split_.begun()) sites_.part(bodies_, begun->from, begun->to);
  tick.split = split_.answer();
  tick.bridge = split_.isBreaking() ? BreakAnswer::breaking : breaks_.answer(bodies_);
  tick.site = sites_.answer();
  tick.chips = chips_.answer();
  tick.pieces = static_cast<std::uint8_t>(bodies_.pieces());
  for (std::size_t n = 0; n < bodies_.pieces(); ++n) tick.X_PQ[n] = bodies_.pose(n);
  tick.strokes = static_cast<std::uint8_t>(undo_.strokes().strokes());
  tick.undone_strokes = static_cast<std::uint8_t>(undo_.strokes().undoneStrokes());
  tick.restored_total_mm3 = undo_.restoredTotal_mm3();
  tick.bone_digest = bodies_.digest();
  tick.removed_total_mm3 = bodies_.removedByTissue_mm3();
  return tick;
}

}  // namespace haptics
