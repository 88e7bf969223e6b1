#include "haptics/servo/servo.h"

#include <algorithm>
#include <cmath>

#include "haptics/bone/carve.h"
#include "haptics/contact/law_parameters.h"
#include "haptics/contact/overlap.h"

namespace haptics {
namespace {

double within(double value, double least, double most, double otherwise) {
  return std::isfinite(value) ? std::clamp(value, least, most) : otherwise;
}

}  // namespace

Command sanitised(const Command& command) {
  const Command defaults;
  Command safe = command;
  safe.tool = sanitised(command.tool);
  safe.law = sanitised(command.law);
  safe.erosion = sanitised(command.erosion);
  safe.spindle = sanitised(command.spindle);
  safe.safety = sanitised(command.safety);
  return safe;
}

Tick Servo::step(const HandSample& hand, const Command& wanted, double dt_s) noexcept {
  const Command command = sanitised(wanted);
  Tick tick;
  tick.index = next_index_++;
  tick.dt_s = within(dt_s, 1e-6, 0.02, 1e-3);
  tick.t_s = t_s_;
  t_s_ += tick.dt_s;
  tick.command_serial = command.serial;
  tick.hand = hand;

  // The hand, or where it last was when it cannot be believed.
  const SafetyLayer::Admitted admitted = safety_.admit(hand, command.safety, command.rearm, tick.dt_s);
  const HandSample& believed = admitted.hand;
  // Where nothing pushes nothing holds: the proxy goes with the hand.
  if (admitted.relocated || (command.safety.must_be_armed && admitted.state != SafetyState::active)) proxy_.release();
  tick.faults = admitted.faults;
  tick.state = admitted.state;

  // Bone comes back before anyone looks at it.
  const double returned_mm3 = undo_.restore(bone_, command.undo_serial, command.tool, X_PQ_);
  const bool embedded = undo_.isToolEmbedded();

  // The pedal turns the bur. A foot that cannot be believed is still where it was.
  const bool foot = believed.drill_pedal && command.drill_enabled;
  tick.drill_inhibit = undo_.inhibitFor(foot || !admitted.mayDrill());
  tick.drilling = foot && admitted.mayDrill() && tick.drill_inhibit == DrillInhibit::none;
  cutting_.turn(command.spindle, tick.drilling, tick.dt_s);
  tick.spindle_rad_per_s = cutting_.spindle().rad_per_s;

  // Contact at the place where the surface holds the tool.
  const ToolMotion motion = cutting_.motion(believed.velocity_P_mm_per_s, tick.dt_s);
  const Proxy::State held = embedded
                                ? proxy_.passThrough(bone_.field(), command.law, command.tool, believed.X_PT, motion)
                                : proxy_.follow(bone_.field(), command.law, command.tool, believed.X_PT, motion,
                                                command.safety.max_stiffness_N_per_mm);
  if (embedded && !held.touches()) undo_.release();
  X_PQ_ = {believed.X_PT.rotation, held.proxy_P.mm};
  tick.proxy_P = held.proxy_P;
  tick.overlap_mm3 = held.head.volume_mm3;
  tick.depth_mm = held.head.depth_mm;
  tick.contact_tissue = held.head.depth_mm > 0.0
                            ? dominantLabel(bone_.field(), held.proxy_P, command.tool.head.radius_mm)
                            : std::uint8_t{0};

  // What the law wants, then what may be given of it.
  tick.law_force_P_N = held.force_P_N() + dampingForce_N(command.law, held.touching(), believed.velocity_P_mm_per_s);
  tick.law_torque_P_Nmm = held.torque_P_Nmm();
  Delivery::Request wish{{tick.law_force_P_N, tick.law_torque_P_Nmm}, held.head.vibration_P_N, held.maxStored_Nmm()};
  wish.switched = command.serial != last_serial_ || embedded != was_embedded_;
  wish.relocated = admitted.relocated;
  wish.touches = held.touches();
  last_serial_ = command.serial;
  was_embedded_ = embedded;
  const SafetyFilter::Delivered served = delivery_.deliver(wish, believed, safety_, command.safety, tick.dt_s);
  tick.commanded_force_P_N = served.wrench_P.force_N;
  tick.commanded_torque_P_Nmm = served.wrench_P.torque_Nmm;
  tick.energy_Nmm = safety_.energy_Nmm();
  tick.faults = tick.faults | served.faults;

  // The bur cuts where it is felt.
  const Cutting::Engagement at{X_PQ_, command.tool.head, embedded ? Contact{} : held.head, held.force_P_N()};
  const CarveResult removed = cutting_.cut(bone_, undo_.strokes(), command.erosion, command.spindle, command.law, at,
                                           tick.drilling, tick.dt_s, tick.index);
  undo_.follow(tick.drilling && held.head.volume_mm3 > 0.0, tick.dt_s);
  tick.removed_mm3 = removed.removed_mm3 - returned_mm3;
  tick.strokes = static_cast<std::uint8_t>(undo_.strokes().strokes());
  tick.bone_digest = bone_.digest();
  tick.removed_total_mm3 = bone_.removedByTissue_mm3();
  return tick;
}

}  // namespace haptics
