// The soft tissue among the drawn meshes: gingiva, flap, lips, cheek, tongue, mucosa, each triangle with its tissue.
// Frame P; mm. By the names of the parts; in the built-in face the lips are what lies within 10 mm of the line where
// skin and lining meet, the cheek what else is skin, or lining at the side that faces the mouth. Hair, teeth, cloth and
// metal are none. Any thread; about 50 ns a triangle.
#pragma once

#include <vector>

#include "assets/mesh.h"
#include "assets/soft_tissue.h"

namespace assets {

/// One body with its surface; vertices at the same place are one, so that its triangles are connected.
struct SoftTissueSurface {
  std::vector<glm::dvec3> position_P_mm;
  std::vector<glm::uvec3> triangles;  ///< counter-clockwise from outside
  std::vector<SoftTissue> tissue;     ///< one per triangle
};

/// Where soft tissue matters: around the site, as far as the handpiece gets.
struct SoftTissueRegion {
  glm::dvec3 centre_P_mm{0.0};
  double reach_mm = 75.0;
};

/// The bodies: gingiva (with a flap), head, tongue. Only triangles with a corner in the region.
std::vector<SoftTissueSurface> softTissueSurfaces(const MeshModel& gingiva_P, const MeshModel& face_P,
                                                  const SoftTissueRegion& region);

}  // namespace assets
