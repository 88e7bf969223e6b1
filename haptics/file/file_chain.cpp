#include "haptics/file/file_chain.h"

#include <cassert>

namespace haptics {
namespace {

FileChain linksOf(double length_mm, std::size_t links) {
  assert(links >= kFewestLinks && links <= kMostLinks);
  FileChain chain;
  chain.links = links;
  chain.link_mm = length_mm / static_cast<double>(links);
  return chain;
}

}  // namespace

FileChain fileChain(const assets::KFile& file, std::size_t links) {
  FileChain chain = linksOf(file.length_mm, links);
  chain.metal = fileMetal(file.metal);
  chain.lead_mm = file.lead_mm();
  const auto thickness_mm = [&](double joint) { return file.diameter_mm(file.length_mm - joint * chain.link_mm); };
  chain.radius_mm[0] = 0.5 * thickness_mm(0.0);
  for (std::size_t i = 1; i <= links; ++i) {
    const double at = static_cast<double>(i), joint_mm = thickness_mm(at - 1.0), middle_mm = thickness_mm(at - 0.5);
    chain.radius_mm[i] = 0.5 * thickness_mm(at);
    chain.wire_mm2[i] = fileSection(file.section(), thickness_mm(at)).area_mm2;

    const FileSection section = fileSection(file.section(), joint_mm);
    JointStiffness& bend = chain.bend[i];
    bend.stiffness_Nmm_per_rad =
        (i == 1 ? 2.0 : 1.0) * chain.metal.young_N_per_mm2 * section.bending_mm4 / chain.link_mm;
    if (chain.metal.plateau_N_per_mm2 > 0.0) {
      bend.plateau_share = chain.metal.plateau_share;
      bend.plateau_rad = chain.metal.plateau_N_per_mm2 * section.plastic_mm3 /
                         (bend.stiffness_Nmm_per_rad * (1.0 - bend.plateau_share));
    }
    // The clamp stands for half a link.
    chain.strain_per_rad[i] = 0.5 * joint_mm / (i == 1 ? 0.5 * chain.link_mm : chain.link_mm);
    chain.twist_Nmm_per_rad[i] =
        chain.metal.shear_N_per_mm2 * fileSection(file.section(), middle_mm).torsion_mm4 / chain.link_mm;
    chain.breaking_Nmm[i] = breakingTorque_Nmm(chain.metal, middle_mm);
  }
  return chain;
}

FileChain uniformChain(double length_mm, double bending_N_mm2, double radius_mm, std::size_t links) {
  FileChain chain = linksOf(length_mm, links);
  chain.metal = fileMetal(assets::KFileMetal::steel);
  chain.metal.set_strain = 0.0;
  chain.lead_mm = 2.0;
  chain.radius_mm.fill(radius_mm);
  for (std::size_t i = 1; i <= links; ++i) {
    chain.bend[i].stiffness_Nmm_per_rad = (i == 1 ? 2.0 : 1.0) * bending_N_mm2 / chain.link_mm;
    chain.strain_per_rad[i] = radius_mm / (i == 1 ? 0.5 * chain.link_mm : chain.link_mm);
    chain.twist_Nmm_per_rad[i] = bending_N_mm2 / chain.link_mm;
    chain.breaking_Nmm[i] = breakingTorque_Nmm(chain.metal, 2.0 * radius_mm);
  }
  return chain;
}

void ChainShape::place(const FileChain& chain) {
  for (std::size_t i = 1; i <= chain.links; ++i) node_mm[i] = node_mm[i - 1] + chain.link_mm * direction[i];
}

ChainShape straightShape(const FileChain& chain, const glm::dvec3& base_mm, const glm::dvec3& axis) {
  ChainShape shape;
  shape.direction.fill(axis);
  shape.node_mm[0] = base_mm;
  shape.place(chain);
  return shape;
}

}  // namespace haptics
