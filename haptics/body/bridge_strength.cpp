#include "haptics/body/bridge_strength.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace haptics {
namespace {

/// h of the notched section.
double height_mm(const Bridge& bridge) { return bridge.area_mm2 / bridge.width_mm; }

/// Of a section bent from a deep notch (handbook, unverified).
double intensity_N_per_mm15(double bending_Nmm, double width_mm, double height_mm) {
  return 3.975 * bending_Nmm / (width_mm * height_mm * std::sqrt(height_mm));
}

}  // namespace

BridgeLoad wedgedBy(const Bridge& bridge, double wedging_N) {
  return {wedging_N, wedging_N * (kLever_mm + 0.5 * height_mm(bridge)), 0.0};
}

double shareOfBreaking(const Bridge& bridge, double enamel_share, const BridgeLoad& load) {
  const double b_mm = bridge.width_mm, h_mm = height_mm(bridge);
  // Not above 0 for a width of 0, either.
  if (!(bridge.area_mm2 > 0.0 && b_mm > 0.0 && bridge.thickness_mm > 0.0))
    return std::numeric_limits<double>::infinity();
  const double i_u_mm4 = bridge.area_mm2 * bridge.thickness_mm * bridge.thickness_mm / 12.0;
  const double i_v_mm4 = bridge.area_mm2 * b_mm * b_mm / 12.0;
  const double m_u_Nmm = std::abs(load.bending_u_Nmm), m_v_Nmm = std::abs(load.bending_v_Nmm);
  const double stress_N_per_mm2 = load.tension_N / bridge.area_mm2 + m_u_Nmm * bridge.half_thickness_mm / i_u_mm4 +
                                  m_v_Nmm * bridge.half_width_mm / i_v_mm4;
  const double intensity = intensity_N_per_mm15(m_u_Nmm, b_mm, h_mm) + intensity_N_per_mm15(m_v_Nmm, h_mm, b_mm);
  const double material = 1.0 - (1.0 - DentineLimits::kEnamelFactor) * enamel_share;
  return std::min(stress_N_per_mm2 / DentineLimits::kStrength_N_per_mm2,
                  intensity / DentineLimits::kToughness_N_per_mm15) /
         material;
}

double breakingForce_N(const Bridge& bridge, double enamel_share) {
  return 1.0 / shareOfBreaking(bridge, enamel_share, wedgedBy(bridge, 1.0));
}

double breakingTwist_Nmm(const Bridge& bridge, double enamel_share) {
  return kBladeArm_mm * breakingForce_N(bridge, enamel_share);
}

}  // namespace haptics
