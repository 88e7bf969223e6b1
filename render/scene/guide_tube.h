// Lines drawn as tubes of triangles: the mandibular canal, whole where it lies open and as dim dashes for where bone or
// gum lies before it, and ruler and arrow. Frame P, mm. A dash lies exactly on the whole tube, and has no ends of its
// own: seen where the whole tube is hidden, it must not be hidden by that. Start-up, and whenever the ruler changes;
// pure.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "assets/mesh.h"
#include "render/frame.h"

namespace render {

/// Closed at both ends. Empty for fewer than two distinct points.
assets::MeshModel mandibularCanalTube(std::span<const glm::dvec3> line_P_mm, double radius_mm);

/// The same in dashes of that length along the line and gaps between them, darker.
assets::MeshModel mandibularCanalDashes(std::span<const glm::dvec3> line_P_mm, double radius_mm);

/// A thin line with a bead at each marked point; `behind`: as it is seen through bone, darker.
assets::MeshModel rulerMesh(const RulerLine& ruler, bool behind);

/// A thin shaft with a head at its end; `behind`: alike.
assets::MeshModel arrowMesh(const GuideArrow& arrow, bool behind);

inline constexpr double kArrowRadius_mm = 0.1, kArrowHead_mm = 0.35, kArrowHeadLength_mm = 1.0;
inline constexpr double kRulerRadius_mm = 0.14, kRulerBead_mm = 0.4;  ///< radii
inline constexpr double kCanalDash_mm = 1.8, kCanalDashGap_mm = 1.2;

}  // namespace render
