#include "haptics/servo/proxy.h"

#include <algorithm>

#include "calibration/geometry/units.h"
#include "haptics/contact/cap.h"
#include "haptics/contact/shaft_contact.h"

namespace haptics {
namespace {

using calibration::Patient;
using calibration::Vector;

constexpr double kThinnestPlate_mm = 0.6, kShareOfPlate = 0.85;
constexpr double kShaftDepth = 0.25;  // of its radius: where its depth is still accurate
constexpr double kLawStateStep_s = 1e-3;

/// A law's contact, faded where bone on opposite sides cancels out: in a slot narrower than the head a volume law
/// reverses its force within 0.01 mm. Flat bone is one-sided by 1, a conforming socket by 2/3; below 0.6 the contact
/// counts only its share. (shaftContact fades by itself.)
Contact faded(Contact contact) {
  const double share = std::clamp(contact.one_sided / 0.6, 0.0, 1.0);
  contact.force_P_N.xyz *= share;
  contact.torque_P_Nmm.xyz *= share;
  contact.vibration_P_N.xyz *= share;
  contact.normal_P.xyz *= share;
  return contact;
}

/// Scaled down to the stiffness the device can render.
Contact softened(Contact contact, double max_stiffness_N_per_mm) {
  if (!(contact.stiffness_N_per_mm > max_stiffness_N_per_mm)) return contact;
  const double scale = max_stiffness_N_per_mm / contact.stiffness_N_per_mm;
  contact.stiffness_N_per_mm = max_stiffness_N_per_mm;
  contact.force_P_N.xyz *= scale;
  contact.torque_P_Nmm.xyz *= scale;
  return contact;
}

/// A move goes at least `least_mm` along the unit normal, so that it ends no deeper than h_max. No constraint out of
/// contact or without a direction.
struct Constraint {
  glm::dvec3 normal{0.0};
  double least_mm = -1e300;

  double missing_mm(const glm::dvec3& move) const { return least_mm - glm::dot(move, normal); }
};

Constraint constraintOf(const Contact& contact, double deepest_mm) {
  const double length = glm::length(contact.normal_P.xyz);
  if (contact.depth_mm <= 0.0 || length < 1e-6) return {};
  return {contact.normal_P.xyz / length, (contact.depth_mm - deepest_mm) * length};
}

/// The move nearest to `to_hand` that both constraints allow, by trying which of them are active.
glm::dvec3 allowed(const glm::dvec3& to_hand, const Constraint& a, const Constraint& b) {
  const double of_a = a.missing_mm(to_hand), of_b = b.missing_mm(to_hand);
  if (of_a <= 0.0 && of_b <= 0.0) return to_hand;
  const glm::dvec3 by_a = to_hand + std::max(0.0, of_a) * a.normal, by_b = to_hand + std::max(0.0, of_b) * b.normal;
  if (of_a > 0.0 && b.missing_mm(by_a) <= 0.0) return by_a;
  if (of_b > 0.0 && a.missing_mm(by_b) <= 0.0) return by_b;
  // Into the corner between them; facing walls are both met half-way.
  const double g = glm::dot(a.normal, b.normal), det = std::max(1.0 - g * g, 0.01);
  const double along_a = std::max(0.0, (of_a - g * of_b) / det), along_b = std::max(0.0, (of_b - g * of_a) / det);
  return to_hand + along_a * a.normal + along_b * b.normal;
}

}  // namespace

double maxLawDepth_mm(const BurShape& head) {
  const double r = largestBall_mm(head);
  const double plate_mm3 =
      calibration::kPi * kThinnestPlate_mm * (r * r - kThinnestPlate_mm * kThinnestPlate_mm / 12.0);
  double deepest_mm = std::min(0.5 * r, capHeight_mm(r, kShareOfPlate * std::max(0.0, plate_mm3)));
  // On its side a long head shares segments of height h: at most (4/3) sqrt(2 r) h^1.5.
  if (head.kind != ShapeKind::sphere)
    deepest_mm =
        std::min(deepest_mm, std::pow(1.5 * kShareOfPlate * kThinnestPlate_mm * std::sqrt(0.5 * r), 2.0 / 3.0));
  // A flat end shares its depth times its area.
  if (hasFlatEnd(head)) deepest_mm = std::min(deepest_mm, kShareOfPlate * kThinnestPlate_mm);
  return deepest_mm;
}

Vector<Patient> Proxy::State::force_P_N() const {
  if (!touches()) return {};
  return head.force_P_N + shaft.force_P_N + spring_N_per_mm * stretch_P_mm;
}

Vector<Patient> Proxy::State::torque_P_Nmm() const { return head.torque_P_Nmm + shaft.torque_P_Nmm; }

double Proxy::State::maxStored_Nmm() const {
  if (!touches()) return 0.0;
  double stored_Nmm = 0.0, all_N = 0.0;
  for (const Contact* contact : {&head, &shaft}) {
    const double force_N = glm::length(contact->force_P_N.xyz);
    stored_Nmm += (contact->stiffness_N_per_mm * contact->depth_mm + force_N) * contact->depth_mm;
    all_N += force_N;
  }
  const double pull_mm = glm::length(stretch_P_mm.xyz);
  return stored_Nmm + (spring_N_per_mm * pull_mm + all_N) * pull_mm;
}

Proxy::State Proxy::update(const SolidBodies& bodies, const LawSettings& law, const Tool& tool,
                           const calibration::Pose<Patient, calibration::Tool>& X_PT, const ToolMotion& motion,
                           double max_stiffness_N_per_mm) noexcept {
  // Steps are so short that no plate fits between two evaluations; a micrometre is not worth another.
  const bool with_shaft = tool.shaft.length_mm > 0.0 && tool.shaft.radius_mm > 0.0;
  double longest_mm = 0.5 * largestBall_mm(tool.head);
  if (with_shaft) longest_mm = std::min(longest_mm, 0.5 * tool.shaft.radius_mm);
  const double enough_mm = 1e-3;
  // Fewer evaluations where they are expensive: the proxy continues in the next tick.
  const int max_evaluations = tool.head.radius_mm > 25.0 * bodies.spacing_mm() ? kMaxEvaluations / 2 : kMaxEvaluations;
  const double deepest_mm = maxLawDepth_mm(tool.head);
  const double shaft_deepest_mm = with_shaft ? kShaftDepth * tool.shaft.radius_mm : 1.0;

  const glm::dvec3& hand_mm = X_PT.translation_mm;
  if (!placed_) {
    proxy_P_.mm = hand_mm;
    head_ = {};
    shaft_ = {};
    step_scale_ = 1.0;
    placed_ = true;
  }
  if (law.kind != last_law_ || tool.head != last_head_) law_state_ = {};
  last_law_ = law.kind;
  last_head_ = tool.head;
  if (!with_shaft) shaft_ = {};

  // The first step uses the contact of the last tick, later ones and the force the current one.
  State now;
  Contact bare;
  glm::dvec3 last_move(0.0);
  const auto at = [&] { return ToolInBone{bodies, tool.head, {X_PT.rotation, proxy_P_.mm}, law.tissue, motion}; };
  while (now.evaluations < max_evaluations) {
    const glm::dvec3 to_hand = hand_mm - proxy_P_.mm;
    glm::dvec3 move = allowed(to_hand, constraintOf(head_, deepest_mm), constraintOf(shaft_, shaft_deepest_mm));
    // In a corner each wall alone sends the move towards the other: oscillating moves are shortened.
    const bool free = move == to_hand, swings = now.evaluations > 0 && glm::dot(move, last_move) < 0.0;
    if (free)
      step_scale_ = 1.0;
    else if (swings && glm::length(move) > 10.0 * enough_mm)
      step_scale_ = std::max(0.5 * step_scale_, 1.0 / 32.0);
    else
      step_scale_ = std::min(1.1 * step_scale_, 1.0);
    last_move = move;
    if (!free) move *= step_scale_;
    const double length = glm::length(move);
    if (now.evaluations > 0 && length <= enough_mm) break;
    if (length > longest_mm) move *= longest_mm / length;
    proxy_P_.mm += move;
    bare = contactOf(law, at(), law_state_);
    head_ = softened(faded(bare), max_stiffness_N_per_mm);
    // The shaft is a wall with Agus's stiffness under every law.
    if (with_shaft)
      shaft_ =
          softened(shaftContact(bodies, tool, {X_PT.rotation, proxy_P_.mm}, law.tissue, law.agus.stiffness_N_per_mm),
                   max_stiffness_N_per_mm);
    ++now.evaluations;
  }
  // The law's state advances by the millisecond at every rate.
  law_state_age_s_ += motion.dt_s;
  if (law_state_age_s_ > kLawStateStep_s * (1.0 - 1e-6)) {
    updateLawState(law, at(), bare, law_state_);
    law_state_age_s_ = std::min(law_state_age_s_ - kLawStateStep_s, kLawStateStep_s);
  }
  now.head = head_;
  now.shaft = shaft_;
  now.proxy_P = proxy_P_;
  now.stretch_P_mm.xyz = proxy_P_.mm - hand_mm;
  // The slopes weighted by depth relative to h_max, so that neither enters with a step.
  const double by_head = head_.depth_mm / deepest_mm, by_shaft = shaft_.depth_mm / shaft_deepest_mm;
  if (by_head + by_shaft > 0.0)
    now.spring_N_per_mm =
        (by_head * head_.stiffness_N_per_mm + by_shaft * shaft_.stiffness_N_per_mm) / (by_head + by_shaft);
  return now;
}

Proxy::State Proxy::passThrough(const SolidBodies& bodies, const LawSettings& law, const Tool& tool,
                                const calibration::Pose<Patient, calibration::Tool>& X_PT,
                                const ToolMotion& motion) noexcept {
  release();
  law_state_ = {};
  const Contact head = contactOf(law, {bodies, tool.head, X_PT, law.tissue, motion}, law_state_);
  const Contact shaft = shaftContact(bodies, tool, X_PT, law.tissue, 0.0);
  State now;
  now.evaluations = 1;
  now.proxy_P.mm = X_PT.translation_mm;
  now.head.depth_mm = head.depth_mm;
  now.head.volume_mm3 = head.volume_mm3;
  now.shaft.depth_mm = shaft.depth_mm;
  now.shaft.volume_mm3 = shaft.volume_mm3;
  return now;
}

}  // namespace haptics
