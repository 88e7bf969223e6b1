#include "haptics/contact/law_limits.h"

#include <algorithm>
#include <cmath>

#include "calibration/geometry/units.h"
#include "haptics/tool/flat_overlap.h"

namespace haptics {
namespace {

using calibration::kPi;

constexpr double kTransition_mm = 0.1;

/// Pressure of a law that acts on the head's surface, F = k_s dV/dh; 0 for other laws.
double surfacePressure_N_per_mm3(const LawSettings& law, const BurShape& head) {
  if (law.kind == LawKind::shell) return law.shell.shell_N_per_mm3;
  if (law.kind == LawKind::machining)
    return law.machining.flutes * law.machining.edge_radial_N_per_mm / (2.0 * kPi * head.radius_mm);
  return 0.0;
}

FlatResponse surfaceResponse(double per_mm3, const BurShape& head, double depth_mm, double cos_axis) {
  const double area = flatOverlap(head, depth_mm, cos_axis).area_mm2;
  if (head.kind == ShapeKind::sphere) return {per_mm3 * area, 2.0 * kPi * per_mm3 * (head.radius_mm - depth_mm)};
  const double before =
      depth_mm > kTransition_mm ? flatOverlap(head, depth_mm - kTransition_mm, cos_axis).area_mm2 : 0.0;
  return {per_mm3 * area, per_mm3 * (area - before) / kTransition_mm};
}

/// The parameter a law's force is proportional to.
const LawParameter* gainOf(LawKind law) {
  switch (law) {
    case LawKind::forssim:
      return findLawParameter(law, "force_constant_N");
    case LawKind::hertz:
      return findLawParameter(law, "hertz_N_per_mm2");
    case LawKind::shell:
      return findLawParameter(law, "shell_N_per_mm3");
    case LawKind::machining:
      return findLawParameter(law, "edge_radial_N_per_mm");
    default:
      return findLawParameter(law, "stiffness_N_per_mm");
  }
}

}  // namespace

FlatResponse flatResponse(const LawSettings& law, const BurShape& head, double depth_mm, double cos_axis) noexcept {
  if (!supports(law.kind, head.kind) || !(depth_mm > 0.0)) return {};
  const double R = head.radius_mm, h = std::min(depth_mm, fullDepth_mm(head, cos_axis));
  switch (law.kind) {
    case LawKind::agus:
      return {law.agus.stiffness_N_per_mm * h, law.agus.stiffness_N_per_mm};
    case LawKind::forssim: {
      const FlatOverlap overlap = flatOverlap(head, h, cos_axis);
      const double per_mm3 = law.forssim.force_constant_N / (R * R * R);
      return {per_mm3 * overlap.volume_mm3, per_mm3 * overlap.area_mm2};
    }
    case LawKind::hertz: {
      const double root = law.hertz.hertz_N_per_mm2 * std::sqrt(R * h);
      return {root * h, 1.5 * root};
    }
    case LawKind::shell:
    case LawKind::machining:
      return surfaceResponse(surfacePressure_N_per_mm3(law, head), head, h, cos_axis);
    case LawKind::points: {
      const double k = law.points.stiffness_N_per_mm;
      if (head.kind != ShapeKind::sphere) return {k * h, k};
      const double root = std::sqrt(1.0 - h / (3.0 * R));
      return {k * h * root, k * (1.0 - 0.5 * h / R) / root};
    }
    case LawKind::harmonic: {
      const double k = law.harmonic.stiffness_N_per_mm;
      return h <= R ? FlatResponse{k * h, k} : FlatResponse{k * (2.0 * R - h), -k};
    }
  }
  return {};
}

double stiffestSlope_N_per_mm(const LawSettings& law, const BurShape& head) noexcept {
  // The proxy stays at half a radius or less; forssim's law is stated at its steepest depth, h = R.
  const double deepest_mm = law.kind == LawKind::forssim ? head.radius_mm : 0.5 * head.radius_mm;
  constexpr int kDepths = 32, kAngles = 8;
  double steepest = 0.0;
  for (int angle = 0; angle <= kAngles; ++angle) {
    const double cos_axis = 1.0 - 2.0 * angle / kAngles;
    for (int n = 0; n <= kDepths; ++n) {
      const double depth_mm = std::max(1e-9, deepest_mm * n / kDepths);
      steepest = std::max(steepest, flatResponse(law, head, depth_mm, cos_axis).slope_N_per_mm);
    }
    // A flat end reaches its full area at the end of the transition.
    if (head.kind != ShapeKind::sphere)
      steepest = std::max(steepest, flatResponse(law, head, kTransition_mm, cos_axis).slope_N_per_mm);
    if (head.kind == ShapeKind::sphere) break;
  }
  steepest *= *std::max_element(law.tissue.factor.begin(), law.tissue.factor.end());
  return law.kind == LawKind::forssim ? std::max(steepest, law.forssim.hold_N_per_mm) : steepest;
}

double passiveStiffness_N_per_mm(double device_damping_Ns_per_mm, double law_damping_Ns_per_mm,
                                 double period_s) noexcept {
  return std::max(0.0, 2.0 * (device_damping_Ns_per_mm - std::abs(law_damping_Ns_per_mm)) / period_s);
}

Admission admissible(const LawSettings& law, const BurShape& head, double max_N_per_mm) noexcept {
  if (!supports(law.kind, head.kind)) return {Admission::Answer::no_such_head, 0.0, nullptr, 0.0};
  Admission admission;
  admission.slope_N_per_mm = stiffestSlope_N_per_mm(law, head);
  if (admission.slope_N_per_mm <= max_N_per_mm) return admission;
  admission.answer = Admission::Answer::too_stiff;
  if (law.kind == LawKind::forssim && law.forssim.hold_N_per_mm > max_N_per_mm) {
    admission.lower = findLawParameter(law.kind, "hold_N_per_mm");
    admission.nearest = max_N_per_mm;
    return admission;
  }
  admission.lower = gainOf(law.kind);
  admission.nearest = admission.lower->of(law) * max_N_per_mm / admission.slope_N_per_mm;
  return admission;
}

}  // namespace haptics
