// What the measures of the hand's work read of one tick. Frame P; mm, N, s. Plain values; any thread.
#pragma once

#include <glm/glm.hpp>

#include "haptics/servo/command.h"
#include "haptics/servo/tick.h"

namespace app {

class OriginalSurface;

struct WorkSample {
  double t_s = 0.0, dt_s = 0.0;
  glm::dvec3 bur_P_mm{0.0};  ///< centre of the head, where it is felt and cuts
  glm::dvec3 axis_P{0.0};    ///< from the tip to the shaft
  glm::dvec3 velocity_P_mm_per_s{0.0};
  glm::dvec3 force_P_N{0.0};  ///< on the hand, of the model: before limits and scale
  /// Out of the bone as it was before the first cut, at the place nearest to the bur; 0: none near.
  glm::dvec3 normal_P{0.0};
  double radius_mm = 0.0;
  double removed_mm3 = 0.0;  ///< by this tick; what undo brings back is none
  bool turns = false;        ///< the drill is on
  bool touches = false;      ///< the head is in bone or tooth
  bool irrigated = false;
  bool valid = true;  ///< false: the hand was nowhere in this tick

  bool drills() const { return turns && touches; }
};

/// `surface` may be null: then no normals.
WorkSample workSample(const haptics::Tick& tick, const haptics::Command& in_force, const OriginalSurface* surface);

}  // namespace app
