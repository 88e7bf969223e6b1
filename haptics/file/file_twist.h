// The twist of a file: sections of square and triangular wire bend alike in every direction, so roll changes no bending
// energy and its chain stands alone: handle, links as torsion springs, bristles round the axis. The least energy by
// Newton steps of a tridiagonal system, at most kMostTwistSteps. rad, N mm. Servo thread; no allocation; 0.5 µs a step.
// Source: reference/sisters 1.2, 1.4.
#pragma once

#include "haptics/file/file_chain.h"
#include "haptics/file/file_law.h"
#include "haptics/file/node_friction.h"

namespace haptics {

struct TwistDrag {
  PerNode<FluteFriction> friction{};
  PerNode<Bristle> bristle{};  ///< after the axial way of this tick, round it before
  PerNode<double> normal_N{};
  PerNode<double> screw_Nmm{};  ///< torque that axial sliding gives, on the file
};

struct TwistResult {
  double torque_Nmm = 0.0;  ///< on the file, of the handle
  bool unsettled = false;
};

/// `roll_rad` holds the roll of each node, [0] that of the handle where it is now; the others move to balance.
TwistResult settleTwist(const FileChain& chain, const FileLaw& law, const TwistDrag& drag,
                        PerNode<double>& roll_rad) noexcept;

}  // namespace haptics
