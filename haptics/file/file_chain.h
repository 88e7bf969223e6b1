// A K-file as a chain of links that bend at their joints and do not stretch: link i runs from node i - 1 to node i,
// node 0 is where the shaft leaves the handle, direction 0 the handle's axis towards the tip. All unknowns are
// directions, two rotations per link. The first joint is a clamp of half a link: 2 E I / l, exact to 1 / (2 n^2)
// (reference/sisters 1.2, physics 1.7). mm, rad, N mm. Plain values of fixed size, no allocation; any thread.
#pragma once

#include <array>
#include <cstddef>

#include <glm/glm.hpp>

#include "haptics/file/file_metal.h"
#include "haptics/file/joint_bend.h"

namespace haptics {

inline constexpr std::size_t kMostLinks = 64, kUsualLinks = 32, kFewestLinks = 8;

template <class T>
using PerNode = std::array<T, kMostLinks + 1>;

struct FileChain {
  std::size_t links = kUsualLinks;
  double link_mm = 0.0;
  PerNode<double> radius_mm{};
  PerNode<double> wire_mm2{};           ///< of the metal's section
  PerNode<JointStiffness> bend{};       ///< of joint 1 to `links`, before link i
  PerNode<double> twist_Nmm_per_rad{};  ///< of link 1 to `links`
  PerNode<double> breaking_Nmm{};       ///< of link i
  PerNode<double> strain_per_rad{};     ///< of the outer fibre at joint i
  FileMetal metal{};
  double lead_mm = 1.0;

  double length_mm() const { return link_mm * static_cast<double>(links); }
};

/// `links` from kFewestLinks to kMostLinks.
FileChain fileChain(const assets::KFile& file, std::size_t links);
/// The same stiffness everywhere, for closed forms.
FileChain uniformChain(double length_mm, double bending_N_mm2, double radius_mm, std::size_t links);

struct ChainShape {
  PerNode<glm::dvec3> node_mm{};
  PerNode<glm::dvec3> direction{};

  /// Nodes from node 0 and the directions.
  void place(const FileChain& chain);
};
ChainShape straightShape(const FileChain& chain, const glm::dvec3& base_mm, const glm::dvec3& axis);

}  // namespace haptics
