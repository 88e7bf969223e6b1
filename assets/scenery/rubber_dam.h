// A rubber dam round one tooth: a stretched sheet with a hole that hugs the tooth near its cervical line, sagging a
// little towards its edge, where a frame would hold it. It hides what it keeps dry. Frame P, mm. About 7,000 triangles;
// any thread; 1 ms. Drawn only.
#pragma once

#include <vector>

#include "assets/mesh.h"
#include "assets/tooth_canals.h"

namespace assets {

struct DamHole {
  double height_mm = 1.0;         ///< over the cervical line, along the tooth
  std::vector<double> radius_mm;  ///< of the tooth there, evenly round from mesial towards the cheek; at least 8
};

inline constexpr double kDamEdge_mm = 26.0;

MeshModel rubberDam(const ToothFrame& tooth, const DamHole& hole);

}  // namespace assets
