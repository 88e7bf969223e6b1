#include "haptics/servo/proxy.h"

#include <algorithm>

#include "calibration/geometry/units.h"
#include "haptics/contact/cap.h"

namespace haptics {
namespace {

using calibration::Patient;
using calibration::Vector;

constexpr double kThinnestPlate_mm = 0.6;

/// Agus's contact, faded where bone on opposite sides cancels out: in a slot narrower than the bur the bare law turns
/// its full force round within a hundredth of a millimetre. Flat bone has |M1| of its cap, a conforming socket 2/3 of
/// it; below 0.6 the direction is worth only its share.
AgusContact steadyContact(const SolidField& field, const calibration::Point<Patient>& centre_P, double radius_mm) {
  AgusContact contact = agusContact(field, centre_P, radius_mm);
  const double needed_mm4 = 0.6 * capMoment_mm4(radius_mm, contact.depth_mm);
  if (contact.moment_mm4 < needed_mm4) contact.normal_P.xyz *= contact.moment_mm4 / needed_mm4;
  return contact;
}

/// The part of the way to the hand that the bone at the proxy allows: all of it along the surface, inwards only down to
/// the depth where the proxy waits, outwards at least until it is no deeper.
glm::dvec3 allowed(const glm::dvec3& to_hand, const AgusContact& contact, double deepest_mm) {
  const double length = glm::length(contact.normal_P.xyz);
  if (contact.depth_mm <= 0.0 || length < 1e-6) return to_hand;
  const glm::dvec3 normal = contact.normal_P.xyz / length;
  const double outwards = glm::dot(to_hand, normal);
  return to_hand + normal * (std::max(outwards, (contact.depth_mm - deepest_mm) * length) - outwards);
}

}  // namespace

double deepestPureContact_mm(double radius_mm) {
  const double plate =
      calibration::kPi * kThinnestPlate_mm * (radius_mm * radius_mm - kThinnestPlate_mm * kThinnestPlate_mm / 12.0);
  return std::min(0.5 * radius_mm, capHeight_mm(radius_mm, 0.85 * std::max(0.0, plate)));
}

Proxy::Held Proxy::follow(const SolidField& field, const calibration::Point<Patient>& hand_P,
                          double radius_mm) noexcept {
  // A step is short enough that no plate fits between two looks; a miss of a micrometre is not worth another look.
  const double longest_mm = 0.5 * radius_mm, enough_mm = 1e-3;
  // Where one look is dear there are fewer: the proxy goes on in the next tick.
  const int most_sums = radius_mm > 25.0 * field.grid.spacing_mm ? kMostSums / 2 : kMostSums;
  const double deepest_mm = deepestPureContact_mm(radius_mm);

  if (!placed_) {
    proxy_P_ = hand_P;
    contact_ = {};
    placed_ = true;
  }
  // The first step trusts what the last tick saw; every later one, and the force, what is there now.
  Held held;
  while (held.sums < most_sums) {
    glm::dvec3 move = allowed(hand_P.mm - proxy_P_.mm, contact_, deepest_mm);
    const double length = glm::length(move);
    if (held.sums > 0 && length <= enough_mm) break;
    if (length > longest_mm) move *= longest_mm / length;
    proxy_P_.mm += move;
    contact_ = steadyContact(field, proxy_P_, radius_mm);
    ++held.sums;
  }
  held.contact = contact_;
  held.proxy_P = proxy_P_;
  held.pull_P_mm = proxy_P_ - hand_P;
  return held;
}

Vector<Patient> heldForce_N(const Proxy::Held& held, const AgusParameters& parameters,
                            const Vector<Patient>& velocity_P_mm_per_s) noexcept {
  if (held.contact.depth_mm <= 0.0) return {};
  return agusForce_N(held.contact, parameters, velocity_P_mm_per_s) + parameters.stiffness_N_per_mm * held.pull_P_mm;
}

}  // namespace haptics
