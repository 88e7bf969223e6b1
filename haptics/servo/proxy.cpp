#include "haptics/servo/proxy.h"

#include <algorithm>

#include "calibration/geometry/units.h"
#include "haptics/contact/cap.h"

namespace haptics {
namespace {

using calibration::Patient;
using calibration::Vector;

constexpr double kThinnestPlate_mm = 0.6, kShareOfPlate = 0.85;
constexpr double kMemoryStep_s = 1e-3;

bool same(const BurShape& a, const BurShape& b) {
  return a.kind == b.kind && a.radius_mm == b.radius_mm && a.length_mm == b.length_mm;
}

/// The law's contact, faded where bone on opposite sides cancels out: in a slot narrower than the head a volume law
/// turns its full force round within a hundredth of a millimetre. Flat bone is one-sided by 1, a conforming socket by
/// 2/3; below 0.6 the contact is worth only its share.
Contact steadied(Contact contact, double most_stiffness_N_per_mm) {
  const double share = std::clamp(contact.one_sided / 0.6, 0.0, 1.0);
  contact.normal_P.xyz *= share;
  // Steeper than the device can hold: the whole law is scaled down to what it can.
  const double slope = contact.stiffness_N_per_mm;
  const double scale = slope > most_stiffness_N_per_mm ? most_stiffness_N_per_mm / slope : 1.0;
  contact.stiffness_N_per_mm *= scale;
  contact.force_P_N.xyz *= share * scale;
  contact.torque_P_Nmm.xyz *= share * scale;
  contact.vibration_P_N.xyz *= share;
  return contact;
}

/// The part of the way to the hand that the bone at the proxy allows: all of it along the surface, inwards only down to
/// the depth where the proxy waits, outwards at least until it is no deeper.
glm::dvec3 allowed(const glm::dvec3& to_hand, const Contact& contact, double deepest_mm) {
  const double length = glm::length(contact.normal_P.xyz);
  if (contact.depth_mm <= 0.0 || length < 1e-6) return to_hand;
  const glm::dvec3 normal = contact.normal_P.xyz / length;
  const double outwards = glm::dot(to_hand, normal);
  return to_hand + normal * (std::max(outwards, (contact.depth_mm - deepest_mm) * length) - outwards);
}

/// The radius of the largest ball that fits into the head.
double thinnestRadius_mm(const BurShape& head) {
  if (head.kind == ShapeKind::cone) {
    const double slant_mm = std::hypot(head.radius_mm, head.length_mm);
    return head.radius_mm * head.length_mm / (head.radius_mm + slant_mm);
  }
  return head.kind == ShapeKind::cylinder ? std::min(head.radius_mm, 0.5 * head.length_mm) : head.radius_mm;
}

}  // namespace

double deepestPureContact_mm(const BurShape& head) {
  const double r = thinnestRadius_mm(head);
  const double plate_mm3 =
      calibration::kPi * kThinnestPlate_mm * (r * r - kThinnestPlate_mm * kThinnestPlate_mm / 12.0);
  double deepest_mm = std::min(0.5 * r, capHeight_mm(r, kShareOfPlate * std::max(0.0, plate_mm3)));
  // Lying on its side a long head shares segments of the height h: (4/3) sqrt(2 r) h^1.5 is never less than they are.
  if (head.kind != ShapeKind::sphere)
    deepest_mm =
        std::min(deepest_mm, std::pow(1.5 * kShareOfPlate * kThinnestPlate_mm * std::sqrt(0.5 * r), 2.0 / 3.0));
  // A flat end shares what it is deep.
  if (head.kind == ShapeKind::cylinder || head.kind == ShapeKind::cone)
    deepest_mm = std::min(deepest_mm, kShareOfPlate * kThinnestPlate_mm);
  return deepest_mm;
}

Vector<Patient> Proxy::Held::force_P_N() const {
  if (!touches()) return {};
  return head.force_P_N + spring_N_per_mm * pull_P_mm;
}

Vector<Patient> Proxy::Held::torque_P_Nmm() const { return touches() ? head.torque_P_Nmm : Vector<Patient>{}; }

double Proxy::Held::mostStored_Nmm() const {
  if (!touches()) return 0.0;
  const double force_N = glm::length(head.force_P_N.xyz), pull_mm = glm::length(pull_P_mm.xyz);
  return (head.stiffness_N_per_mm * head.depth_mm + force_N) * head.depth_mm +
         (spring_N_per_mm * pull_mm + force_N) * pull_mm;
}

Proxy::Held Proxy::follow(const SolidField& field, const LawSettings& law, const Tool& tool,
                          const calibration::Pose<Patient, calibration::Tool>& X_PT, const ToolMotion& motion,
                          double most_stiffness_N_per_mm) noexcept {
  // A step is short enough that no plate fits between two looks; a miss of a micrometre is not worth another look.
  const double thinnest_mm = thinnestRadius_mm(tool.head), longest_mm = 0.5 * thinnest_mm, enough_mm = 1e-3;
  // Where one look is dear there are fewer: the proxy goes on in the next tick.
  const int most_looks = tool.head.radius_mm > 25.0 * field.grid.spacing_mm ? kMostLooks / 2 : kMostLooks;
  const double deepest_mm = deepestPureContact_mm(tool.head);

  const glm::dvec3& hand_mm = X_PT.translation_mm;
  if (!placed_) {
    proxy_P_.mm = hand_mm;
    head_ = {};
    placed_ = true;
  }
  if (law.kind != last_law_ || !same(tool.head, last_head_)) law_state_ = {};
  last_law_ = law.kind;
  last_head_ = tool.head;

  // The first step trusts what the last tick saw; every later one, and the force, what is there now.
  Held held;
  Contact bare;
  const auto at = [&] { return ToolInBone{field, tool.head, {X_PT.rotation, proxy_P_.mm}, law.tissue, motion}; };
  while (held.looks < most_looks) {
    glm::dvec3 move = allowed(hand_mm - proxy_P_.mm, head_, deepest_mm);
    const double length = glm::length(move);
    if (held.looks > 0 && length <= enough_mm) break;
    if (length > longest_mm) move *= longest_mm / length;
    proxy_P_.mm += move;
    bare = contactOf(law, at(), law_state_);
    head_ = steadied(bare, most_stiffness_N_per_mm);
    ++held.looks;
  }
  // A law's memory goes by the millisecond, whatever the rate.
  unremembered_s_ += motion.dt_s;
  if (unremembered_s_ > kMemoryStep_s * (1.0 - 1e-6)) {
    remember(law, at(), bare, law_state_);
    unremembered_s_ = std::min(unremembered_s_ - kMemoryStep_s, kMemoryStep_s);
  }
  held.head = head_;
  held.proxy_P = proxy_P_;
  held.pull_P_mm.xyz = proxy_P_.mm - hand_mm;
  held.spring_N_per_mm = head_.stiffness_N_per_mm;
  return held;
}

}  // namespace haptics
