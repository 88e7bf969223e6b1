// One Newton step of a chain: the system in the rotations of all links, with loads and stiffness at its nodes, is a
// linear-quadratic control problem (state: place of a node and tilt of the link before it; control: tilt of the next),
// so a sweep from the tip to the handle with 2x2 inverses solves it exactly, O(n). What the sweep leaves at the handle
// is the stiffness that the hand feels. Exact as it is; tamed, the curvature of compressed links is left out and that
// of the loads made positive: for where the exact one is not definite. mm, N, N mm. Servo thread; no allocation; 0.1 µs
// a link. Source: reference/sisters 1.2.
#pragma once

#include "haptics/file/file_chain.h"

namespace haptics {

/// Something fixed to the shaft, `share` of link `link` from its first node: the rubber stop.
struct ShaftLoad {
  std::size_t link = 0;  ///< 0: none
  double share = 0.0;
  glm::dvec3 force_N{0.0};
  glm::dmat3 stiffness_N_per_mm{0.0};
};

/// What acts on the nodes at a shape, with its stiffness (minus the slope), and the bends there.
struct ChainBalance {
  PerNode<glm::dvec3> force_N{};
  PerNode<glm::dmat3> stiffness_N_per_mm{};
  PerNode<JointBend> bend{};
  PerNode<double> normal_N{};  ///< sum of what presses a section, opposed too
  ShaftLoad stop;
  double energy_Nmm = 0.0;
};

/// Directions of the bend's rest: what a joint turns the link before it by, unbent. Null turns: straight.
struct RestTurns {
  PerNode<glm::dmat3> turn{};
  bool straight = true;
};

/// What holds node 0.
struct BaseSpring {
  bool rigid = true;
  double N_per_mm = 0.0;
  glm::dvec3 pull_N{0.0};  ///< on node 0, at this shape
};

struct ChainStep {
  PerNode<glm::dvec3> turn{};  ///< of each direction, along the tangent plane
  glm::dvec3 base_mm{0.0};
  double descent_Nmm = 0.0;       ///< how fast the energy falls along it
  double farthest_mm = 0.0;       ///< of a node
  bool is_definite = true;        ///< no link had to be stiffened
  glm::dmat3 felt_N_per_mm{0.0};  ///< stiffness of the chain at node 0
  glm::dmat3 follow{1.0};         ///< way of node 0 for a way of the spring's other end
};

ChainStep newtonStep(const FileChain& chain, const ChainShape& shape, const ChainBalance& balance,
                     const RestTurns& rest, const BaseSpring& base, bool tames) noexcept;

/// The shape after a share of a step.
ChainShape moved(const FileChain& chain, const ChainShape& shape, const ChainStep& step, double share) noexcept;

}  // namespace haptics
