#include "haptics/file/cone_chain.h"

#include <cassert>
#include <numbers>

namespace haptics {

FileChain coneChain(const assets::GuttaPerchaCone& cone, std::size_t links) {
  assert(links >= kFewestLinks && links <= kMostLinks);
  constexpr double kNever = 1e9;
  FileChain chain;
  chain.links = links;
  chain.link_mm = cone.length_mm / static_cast<double>(links);
  chain.metal = {kGuttaPercha_N_per_mm2,
                 0.5 * kGuttaPercha_N_per_mm2 / (1.0 + kGuttaPerchaPoisson),
                 0.0,
                 1.0,
                 0.0,
                 kNever,
                 kNever};
  const auto thickness_mm = [&](double joint) { return cone.diameter_mm(cone.length_mm - joint * chain.link_mm); };
  const auto bending_mm4 = [](double d) { return std::numbers::pi * d * d * d * d / 64.0; };
  chain.radius_mm[0] = 0.5 * thickness_mm(0.0);
  for (std::size_t i = 1; i <= links; ++i) {
    const double at = static_cast<double>(i), joint_mm = thickness_mm(at - 1.0), middle_mm = thickness_mm(at - 0.5);
    chain.radius_mm[i] = 0.5 * thickness_mm(at);
    chain.wire_mm2[i] = std::numbers::pi * chain.radius_mm[i] * chain.radius_mm[i];
    // The clamp stands for half a link.
    chain.bend[i].stiffness_Nmm_per_rad =
        (i == 1 ? 2.0 : 1.0) * chain.metal.young_N_per_mm2 * bending_mm4(joint_mm) / chain.link_mm;
    chain.strain_per_rad[i] = 0.5 * joint_mm / (i == 1 ? 0.5 * chain.link_mm : chain.link_mm);
    chain.twist_Nmm_per_rad[i] = chain.metal.shear_N_per_mm2 * 2.0 * bending_mm4(middle_mm) / chain.link_mm;
    chain.breaking_Nmm[i] = breakingTorque_Nmm(chain.metal, middle_mm);
  }
  return chain;
}

FileLaw coneLaw() {
  FileLaw law;
  law.friction_along = law.friction_across = kConeFriction;
  law.wall_N_per_mm3 = kConeSide_N_per_mm3;
  return law;
}

}  // namespace haptics
