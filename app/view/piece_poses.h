// Where the pieces of the tooth lie, by value: what crosses from the servo to the picture. A piece at the identity is
// at rest and drawn with the jaw. Frames P and Q, mm. Trivially copyable; any thread.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "haptics/body/bodies.h"
#include "haptics/servo/tick.h"
#include "render/frame.h"

namespace app {

struct PiecePoses {
  std::array<haptics::Bodies::PiecePose, haptics::kMaxPieces> X_PQ{};
  std::size_t count = 0;
};

/// Of the bodies as they lie now, also of pieces that hold nothing yet; while nothing moves them.
inline PiecePoses piecePosesOf(const haptics::Bodies& bodies) {
  PiecePoses poses;
  poses.count = std::min(bodies.bones().size() - 1, poses.X_PQ.size());
  for (std::size_t n = 0; n < poses.count; ++n) poses.X_PQ[n] = bodies.pose(n);
  return poses;
}

/// As a tick left them.
inline PiecePoses piecePosesOf(const haptics::Tick& tick) { return {tick.X_PQ, tick.pieces}; }

/// For a frame: those that have left rest.
inline render::MovedPieces movedPieces(const PiecePoses& poses) {
  static_assert(haptics::kMaxPieces == render::kMostPieces);
  render::MovedPieces moved;
  for (std::size_t n = 0; n < poses.count; ++n) {
    const haptics::Bodies::PiecePose& X_PQ = poses.X_PQ[n];
    const bool is_at_rest = X_PQ.rotation == glm::dquat(1.0, 0.0, 0.0, 0.0) && X_PQ.translation_mm == glm::dvec3(0.0);
    if (!is_at_rest) moved[n] = X_PQ;
  }
  return moved;
}

}  // namespace app
