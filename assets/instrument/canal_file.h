// A root-canal file as drawn, bent as it lies, in frame T: origin where it leaves its handle, +z along the handle away
// from the tip. Parts "Wire" (twisted along its cutting part, grey steel, amber and red as its torque
// nears what breaks it), "Handle" in the colour of
// ISO 3630-1 and "Stop", the rubber ring, where there is one. mm. Any thread; about 0.2 ms, so once a frame. Drawn
// only.
#pragma once

#include <span>

#include "assets/instrument/gutta_percha_cone.h"
#include "assets/instrument/k_file.h"
#include "assets/mesh.h"
#include "assets/metal_fragment.h"

namespace assets {

struct DrawnFile {
  KFile file;
  std::span<const glm::vec3> node_T_mm;  ///< from the handle to the tip, evenly spaced; fewer than two: straight
  double whole_mm = 0.0;                 ///< length before it broke; 0: as made
  std::span<const float> torque_share;   ///< of what breaks it, at each node; empty: none
  double stop_mm = 0.0;                  ///< of the ring, from the tip; 0: none
  double roll_rad = 0.0;                 ///< of the flutes
};

MeshModel canalFile(const DrawnFile& drawn);

struct DrawnCone {
  GuttaPerchaCone cone;
  std::span<const glm::vec3> node_T_mm;  ///< as of a DrawnFile
  bool is_held = true;                   ///< else the pliers alone
};

/// A cone of gutta-percha in pliers: parts "Cone" and "Pliers".
MeshModel canalCone(const DrawnCone& drawn);

/// What broken files have left, in frame P: parts "Wire", twisted and grey as the files were.
MeshModel fragmentWires(std::span<const MetalFragment> fragments);

}  // namespace assets
