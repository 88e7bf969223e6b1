#include "haptics/file/file_in_canal.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "haptics/file/file_fragments.h"
#include "haptics/file/material_frame.h"

namespace haptics {
namespace {

using calibration::Patient;
using calibration::Vector;
using glm::dmat3;
using glm::dvec2;
using glm::dvec3;

constexpr double kNoise_Nmm = 1e-9;  ///< of an energy, and that share of it

dvec3 axisOf(const FilePose& X_PT) { return X_PT.rotation * dvec3(0.0, 0.0, -1.0); }

bool isSound(const FilePose& X_PT) {
  const glm::dquat& r = X_PT.rotation;
  const double square = glm::dot(r, r);
  return calibration::isFinite(X_PT.translation_mm) && std::isfinite(square) && square > 0.5 && square < 2.0;
}

}  // namespace

/// What stays as it is while a tick is solved: so its energy is a potential.
struct FileInCanal::Kept {
  PerNode<dvec3> axis;       ///< of each section
  PerNode<dvec3> from_mm;    ///< nodes before the tick
  PerNode<dvec3> guess_mm;   ///< where they would be following the hand and themselves
  PerNode<double> round_mm;  ///< bristle round the axis, with the turn that is expected
  PerNode<dvec3> screw_N;    ///< what turning does along the axis
  PerNode<FluteFriction> flutes;
  RestTurns rest;
};

/// A shape that has more energy is not taken: its sums end where that is certain, with an energy without end.
struct FileInCanal::Limit {
  double most_Nmm = std::numeric_limits<double>::infinity();
  std::size_t suspect = 0;  ///< the section that ended the last ones; 0: none
};

FileInCanal::FileInCanal(const FileChain& chain, const FileLaw& law, const FileGrip& grip, const FilePose& X_PT)
    : chain_(chain), law_(law), grip_(grip), whole_mm_(chain.length_mm()) {
  state_.hand_X_PT = X_PT;
  state_.shape = straightShape(chain, X_PT.translation_mm, axisOf(X_PT));
}

bool FileInCanal::isPressed() const noexcept {
  double normal_N = 0.0;
  for (std::size_t i = 1; i <= chain_.links; ++i) normal_N += state_.normal_N[i];
  return normal_N > 0.0;
}

void FileInCanal::follow(const FilePose& hand_X_PT) noexcept {
  FilePose& at = state_.hand_X_PT;
  const dvec3 old_axis = axisOf(at), old_side = sideOf(at.rotation);

  // So far in a tick and no farther.
  const dvec3 whole = hand_X_PT.translation_mm - at.translation_mm;
  const double far_mm = lengthOf(whole);
  const double most_mm = isPressed() ? kMostPressedStep_mm : kMostHandStep_mm;
  const dvec3 way = far_mm > most_mm ? whole * (most_mm / far_mm) : whole;
  at.translation_mm += way;
  glm::dquat to = hand_X_PT.rotation / std::sqrt(glm::dot(hand_X_PT.rotation, hand_X_PT.rotation));
  double cosine = glm::dot(at.rotation, to);
  if (cosine < 0.0) to = -to, cosine = -cosine;
  const double angle = 2.0 * angleOfSine(std::sqrt(std::max(0.0, 1.0 - cosine * cosine)));
  if (angle > kMostHandTurn_rad)
    to = at.rotation * (1.0 - kMostHandTurn_rad / angle) + to * (kMostHandTurn_rad / angle);
  at.rotation = to / std::sqrt(glm::dot(to, to));

  // What the axis does not explain is roll.
  const dvec3 axis = axisOf(at), side = sideOf(at.rotation), expected = carried(old_side, old_axis, axis);
  const double sine = glm::dot(glm::cross(expected, side), axis);
  const double turned = std::copysign(angleOfSine(std::min(1.0, std::fabs(sine))), sine);
  state_.roll_rad[0] += turned;

  // The file follows itself along the canal.
  ChainShape& shape = state_.shape;
  const dvec3 base_mm = grip_.rigid ? at.translation_mm - shape.node_mm[0] : state_.follow * way;
  const double slid = std::clamp(glm::dot(base_mm, axis) / chain_.link_mm, -1.0, 1.0);
  shape.node_mm[0] += base_mm;
  shape.direction[0] = axis;
  const PerNode<dvec3> old = shape.direction;
  for (std::size_t i = 1; i <= chain_.links; ++i) {
    const dvec3& next = slid > 0.0 ? old[std::min(i + 1, chain_.links)] : old[i - 1];
    shape.direction[i] = unitOf(old[i] + std::fabs(slid) * (next - old[i]));
  }
  shape.place(chain_);
}

ShaftLoad FileInCanal::stopAt(const ChainShape& shape, const FileScene& scene, double& energy_Nmm) const noexcept {
  ShaftLoad load;
  const double from_base_mm = scene.stop ? whole_mm_ - scene.stop->from_tip_mm : -1.0;
  if (from_base_mm < 0.0 || from_base_mm >= chain_.length_mm()) return load;
  const auto link = static_cast<std::size_t>(from_base_mm / chain_.link_mm) + 1;
  const double share = from_base_mm / chain_.link_mm - static_cast<double>(link - 1);
  const dvec3 ring_mm = shape.node_mm[link - 1] + share * chain_.link_mm * shape.direction[link];
  const dvec3& out = scene.stop->out_P;
  const double depth_mm = glm::dot(scene.stop->reference_P_mm - ring_mm, out);
  if (depth_mm <= 0.0) return load;
  load = {link, share, law_.stop_N_per_mm * depth_mm * out, glm::outerProduct(law_.stop_N_per_mm * out, out)};
  energy_Nmm += 0.5 * law_.stop_N_per_mm * depth_mm * depth_mm;
  return load;
}

SectionContact FileInCanal::wallAt(const ChainShape& shape, const Kept& kept, const FileScene& scene,
                                   std::size_t i) const noexcept {
  SectionContact contact;
  if (scene.wall == nullptr) return contact;
  const bool is_tip = i == chain_.links;
  const SectionPlace place{shape.node_mm[i], kept.axis[i], chain_.radius_mm[i],
                           is_tip ? 0.5 * chain_.link_mm : chain_.link_mm};
  addSection(law_, *scene.wall, place, contact);
  if (is_tip) addTip(law_, *scene.wall, place, contact);
  if (scene.laid != nullptr) {
    addSection(law_, *scene.laid, place, contact);
    if (is_tip) addTip(law_, *scene.laid, place, contact);
  }
  if (scene.fragments != nullptr) scene.fragments->press(shape.node_mm[i], chain_.radius_mm[i], contact);
  return contact;
}

/// Bend, friction, drag and the spring to the hand: all but the wall and what takes energy away.
double FileInCanal::besideWall_Nmm(const ChainShape& shape, const Kept& kept, const ChainBalance& sum) const noexcept {
  double energy_Nmm = 0.0, dragged_mm2 = 0.0;
  for (std::size_t i = 1; i <= chain_.links; ++i) {
    energy_Nmm += sum.bend[i].energy_Nmm;
    const dvec3 dragged_mm = shape.node_mm[i] - kept.guess_mm[i];
    dragged_mm2 += glm::dot(dragged_mm, dragged_mm);
    if (!(state_.normal_N[i] > 0.0)) continue;
    const double axial_mm = state_.bristle[i].mm.x + glm::dot(shape.node_mm[i] - kept.from_mm[i], kept.axis[i]);
    energy_Nmm += kept.flutes[i].axial *
                  bristlePull(law_.bristle_N_per_mm, state_.normal_N[i], axial_mm, kept.round_mm[i]).energy_Nmm;
  }
  energy_Nmm += 0.5 * law_.drag_N_per_mm2 * chain_.link_mm * dragged_mm2;
  if (grip_.rigid) return energy_Nmm;
  const dvec3 stretch_mm = state_.hand_X_PT.translation_mm - shape.node_mm[0];
  return energy_Nmm + 0.5 * grip_.N_per_mm * glm::dot(stretch_mm, stretch_mm);
}

/// The wall at every section; false: it has more energy than a shape may have that is taken.
bool FileInCanal::meetWall(const ChainShape& shape, const Kept& kept, const FileScene& scene, const ChainBalance& sum,
                           PerNode<SectionContact>& wall, Limit& limit) const noexcept {
  const bool is_limited = limit.most_Nmm < std::numeric_limits<double>::infinity() && scene.pull_P_N == nullptr;
  double left_Nmm = std::numeric_limits<double>::infinity();
  if (is_limited) {
    left_Nmm = limit.most_Nmm + kNoise_Nmm * (1.0 + std::fabs(limit.most_Nmm)) - besideWall_Nmm(shape, kept, sum);
    // Turning takes no more away than that.
    for (std::size_t i = 1; i <= chain_.links; ++i)
      if (state_.normal_N[i] > 0.0)
        left_Nmm += std::fabs(glm::dot(kept.screw_N[i], shape.node_mm[i] - kept.from_mm[i]));
  }
  // From where it was too much before, then from the tip: there it is most often.
  const std::size_t first = is_limited ? limit.suspect : 0;
  const auto meet = [&](std::size_t i) {
    wall[i] = wallAt(shape, kept, scene, i);
    left_Nmm -= wall[i].energy_Nmm;
    if (left_Nmm < 0.0) limit.suspect = i;
    return left_Nmm >= 0.0;
  };
  if (left_Nmm < 0.0 || (first > 0 && !meet(first))) return false;
  for (std::size_t i = chain_.links; i > 0; --i)
    if (i != first && !meet(i)) return false;
  return true;
}

ChainBalance FileInCanal::balanceAt(const ChainShape& shape, const Kept& kept, const FileScene& scene,
                                    Limit& limit) const noexcept {
  ChainBalance sum;
  for (std::size_t i = 1; i <= chain_.links; ++i) {
    const dvec3 before = kept.rest.straight ? shape.direction[i - 1] : kept.rest.turn[i] * shape.direction[i - 1];
    sum.bend[i] = jointBend(chain_.bend[i], lengthOf(shape.direction[i] - before));
  }
  PerNode<SectionContact> wall;
  if (!meetWall(shape, kept, scene, sum, wall, limit)) {
    sum.energy_Nmm = std::numeric_limits<double>::infinity();
    return sum;
  }
  for (std::size_t i = 1; i <= chain_.links; ++i) {
    sum.energy_Nmm += sum.bend[i].energy_Nmm;
    const dvec3& at_mm = shape.node_mm[i];
    SectionContact& contact = wall[i];

    // Friction along the axis, with the normal force of the tick before.
    const dvec3& axis = kept.axis[i];
    if (state_.normal_N[i] > 0.0) {
      const double axial_mm = state_.bristle[i].mm.x + glm::dot(at_mm - kept.from_mm[i], axis);
      const BristlePull pull = bristlePull(law_.bristle_N_per_mm, state_.normal_N[i], axial_mm, kept.round_mm[i]);
      const double A = kept.flutes[i].axial;
      contact.energy_Nmm += A * pull.energy_Nmm - glm::dot(kept.screw_N[i], at_mm - kept.from_mm[i]);
      contact.force_N += kept.screw_N[i] - A * pull.N * axis;
      contact.stiffness_N_per_mm += glm::outerProduct(A * pull.N_per_mm * axis, axis);
    }
    // Drag: what would snap from one rest to another takes some ticks.
    const dvec3 dragged_mm = at_mm - kept.guess_mm[i];
    const double drag_N_per_mm = law_.drag_N_per_mm2 * chain_.link_mm;
    contact.energy_Nmm += 0.5 * drag_N_per_mm * glm::dot(dragged_mm, dragged_mm);
    if (scene.pull_P_N != nullptr) {
      contact.force_N += (*scene.pull_P_N)[i];
      contact.energy_Nmm -= glm::dot((*scene.pull_P_N)[i], at_mm - kept.from_mm[i]);
    }
    sum.force_N[i] = contact.force_N - drag_N_per_mm * dragged_mm;
    sum.stiffness_N_per_mm[i] = contact.stiffness_N_per_mm + dmat3(drag_N_per_mm);
    sum.normal_N[i] = contact.normal_N;
    sum.energy_Nmm += contact.energy_Nmm;
  }
  sum.stop = stopAt(shape, scene, sum.energy_Nmm);
  if (!grip_.rigid) {
    const dvec3 stretch_mm = state_.hand_X_PT.translation_mm - shape.node_mm[0];
    sum.energy_Nmm += 0.5 * grip_.N_per_mm * glm::dot(stretch_mm, stretch_mm);
  }
  return sum;
}

void FileInCanal::settle(const Kept& kept, const FileScene& scene, FileTick& tick) noexcept {
  ChainShape& shape = state_.shape;
  Limit none, limit;
  balance_ = balanceAt(shape, kept, scene, none);
  tick.evaluations = 1;
  tick.started_Nmm = balance_.energy_Nmm;
  const bool is_met = scene.wall != nullptr || scene.stop.has_value();
  tick.unsettled = true;
  while (tick.unsettled && tick.steps < kMostFileSteps) {
    BaseSpring base{grip_.rigid, grip_.N_per_mm, dvec3(0.0)};
    if (!grip_.rigid) base.pull_N = grip_.N_per_mm * (state_.hand_X_PT.translation_mm - shape.node_mm[0]);
    ChainStep step = newtonStep(chain_, shape, balance_, kept.rest, base, false);
    const bool slides_off = !step.is_definite;
    if (!step.is_definite || !(step.descent_Nmm > 0.0) || (is_met && step.farthest_mm > kFarFileStep_mm))
      step = newtonStep(chain_, shape, balance_, kept.rest, base, true);
    state_.felt_N_per_mm = step.felt_N_per_mm;
    state_.follow = step.follow;
    ++tick.steps;

    // On the wall, where sums are dear, a step of less than that is not worth one.
    if (is_met && step.farthest_mm < kSettledFile_mm) {
      tick.unsettled = false;
      break;
    }

    // The whole step, or as much of it as leads down.
    double share = step.farthest_mm > kMostFileStep_mm ? kMostFileStep_mm / step.farthest_mm : 1.0;
    const bool is_last = step.farthest_mm * share < kSettledFile_mm ||
                         (step.farthest_mm < kNearlySettledFile_mm && 0.5 * step.descent_Nmm < kSettledFile_Nmm);
    const double before_Nmm = balance_.energy_Nmm, noise_Nmm = kNoise_Nmm * (1.0 + std::fabs(before_Nmm));
    const ChainShape before = shape;
    double taken = 0.0;
    bool is_taken = false;
    for (int n = 0; !is_taken && n <= kMostShortenings; ++n, share *= 0.4) {
      const ChainShape tried = moved(chain_, shape, step, share);
      limit.most_Nmm = before_Nmm - 1e-4 * share * step.descent_Nmm + noise_Nmm;
      const ChainBalance found = balanceAt(tried, kept, scene, limit);
      ++tick.evaluations;
      is_taken = found.energy_Nmm <= limit.most_Nmm;
      if (is_taken) shape = tried, balance_ = found, taken = share;
      if (is_last) break;
    }
    // Sliding off an edge or a hill, farther: its steps grow only slowly by themselves.
    for (double farther = 3.0; slides_off && is_taken && !is_last && farther < 30.0; farther *= 3.0) {
      const ChainShape tried =
          moved(chain_, before, step, std::min(farther * taken, kMostFileStep_mm / step.farthest_mm));
      limit.most_Nmm = balance_.energy_Nmm;
      const ChainBalance found = balanceAt(tried, kept, scene, limit);
      ++tick.evaluations;
      if (!(found.energy_Nmm < balance_.energy_Nmm)) break;
      shape = tried, balance_ = found;
    }
    tick.unsettled = !is_last;
    if (!is_taken && !is_last) {
      tick.reverted = true;
      break;
    }
  }
}

void FileInCanal::twistAndSlide(const ChainShape& before, const Kept& kept, FileTick& tick) noexcept {
  TwistDrag drag;
  drag.friction = kept.flutes;
  for (std::size_t i = 1; i <= chain_.links; ++i) {
    drag.bristle[i] = state_.bristle[i];
    drag.bristle[i].mm.x += glm::dot(state_.shape.node_mm[i] - before.node_mm[i], kept.axis[i]);
    drag.normal_N[i] = state_.normal_N[i];
    const BristlePull axial =
        bristlePull(law_.bristle_N_per_mm, state_.normal_N[i], drag.bristle[i].mm.x, drag.bristle[i].mm.y);
    drag.screw_Nmm[i] = -kept.flutes[i].coupled * axial.N * chain_.radius_mm[i];
  }
  const PerNode<double> roll_rad = state_.roll_rad;
  const TwistResult twist = settleTwist(chain_, law_, drag, state_.roll_rad);
  tick.torque_Nmm = twist.torque_Nmm;
  tick.unsettled = tick.unsettled || twist.unsettled;
  for (std::size_t i = 1; i <= chain_.links; ++i) {
    const double turned = state_.roll_rad[i] - roll_rad[i];
    state_.last_roll_rad[i] = turned;
    Bristle stretched = drag.bristle[i];
    stretched.mm.y += chain_.radius_mm[i] * turned;
    state_.bristle[i].mm = stretched.held(law_.bristle_N_per_mm, state_.normal_N[i]);
    state_.slip_mm[i] = stretched.mm - state_.bristle[i].mm;
  }
}

FileTick FileInCanal::step(const FilePose& hand_X_PT, const FileScene& scene) noexcept {
  FileTick tick;
  if (!isSound(hand_X_PT)) {
    tick.refused = true;
    return tick;
  }
  const ChainShape before = state_.shape;
  Kept kept;
  kept.from_mm = before.node_mm;
  for (std::size_t i = 1; i <= chain_.links; ++i) {
    const dvec3& d = before.direction[i];
    kept.axis[i] = i < chain_.links ? unitOf(d + before.direction[i + 1]) : d;
    kept.flutes[i] = fluteFriction(law_.friction_along, law_.friction_across, chain_.radius_mm[i], chain_.lead_mm);
    const dvec2& stretch_mm = state_.bristle[i].mm;
    kept.round_mm[i] = stretch_mm.y + chain_.radius_mm[i] * state_.last_roll_rad[i];
    const double round_N = bristlePull(law_.bristle_N_per_mm, state_.normal_N[i], stretch_mm.y, stretch_mm.x).N;
    kept.screw_N[i] = -kept.flutes[i].coupled * round_N * kept.axis[i];
  }
  kept.rest = restTurns();
  follow(hand_X_PT);
  kept.guess_mm = state_.shape.node_mm;
  settle(kept, scene, tick);
  twistAndSlide(before, kept, tick);
  state_.normal_N = balance_.normal_N;

  // What the hand feels: the spring, or all that pushes the file; bend of the clamp and twist.
  dvec3 force_N = balance_.stop.force_N;
  for (std::size_t i = 1; i <= chain_.links; ++i) {
    force_N += balance_.force_N[i];
    tick.normal_N += balance_.normal_N[i];
  }
  if (!grip_.rigid) force_N = grip_.N_per_mm * (state_.shape.node_mm[0] - state_.hand_X_PT.translation_mm);
  const dvec3 axis = state_.shape.direction[0];
  tick.on_hand.force_N.xyz = force_N;
  tick.on_hand.torque_Nmm.xyz =
      balance_.bend[1].f1 * glm::cross(axis, state_.shape.direction[1]) - tick.torque_Nmm * axis;
  tick.stop_N = lengthOf(balance_.stop.force_N);
  tick.energy_Nmm = balance_.energy_Nmm;
  tick.axial_N_per_mm = glm::dot(axis, state_.felt_N_per_mm * axis);
  wearOut(kept.rest, tick);
  return tick;
}

}  // namespace haptics
