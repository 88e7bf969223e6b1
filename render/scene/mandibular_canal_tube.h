// The mandibular canal as a tube of triangles around its centre line, closed at both ends. Frame P, mm. Start-up; pure.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "assets/mesh.h"

namespace render {

/// Empty for fewer than two distinct points.
assets::MeshModel mandibularCanalTube(std::span<const glm::dvec3> line_P_mm, double radius_mm);

}  // namespace render
