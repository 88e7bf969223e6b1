// The mandibular canal as a tube of triangles around its centre line, closed at both ends: whole where it lies open,
// and as dim dashes for where bone or gum lies before it. Frame P, mm. Start-up; pure.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "assets/mesh.h"

namespace render {

/// Empty for fewer than two distinct points.
assets::MeshModel mandibularCanalTube(std::span<const glm::dvec3> line_P_mm, double radius_mm);

/// The same in dashes of that length and gaps between them, darker.
assets::MeshModel mandibularCanalDashes(std::span<const glm::dvec3> line_P_mm, double radius_mm);

inline constexpr double kCanalDash_mm = 1.8, kCanalDashGap_mm = 1.2;

}  // namespace render
