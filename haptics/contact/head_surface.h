// Quadrature over the surface of a cutting head: patches with position, outward normal and area, in frame T, mm. A
// sphere's patches are denser where the bone is: 16 rings over the cap `reach_mm` deep around `towards`, 8 over the
// rest, 24 patches each; the rings are equal in area, so a cap's area, area vector and moments are right to 0.2 %.
// Other heads: rings along the profile, even in arc length. The patches sum to the whole surface. Any thread; a few ns
// a patch. Calls `visit(const Patch&)`.
#pragma once

#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>

#include "calibration/geometry/units.h"
#include "haptics/tool/bur_shape.h"

namespace haptics {

struct Patch {
  glm::dvec3 position_T{0.0}, normal_T{0.0};
  double area_mm2 = 0.0;
};

inline constexpr int kPatchesRound = 24;

/// Cosine and sine of a step around a ring and of half a step.
inline constexpr glm::dvec2 kStepRound{0.96592582628906829, 0.25881904510252076};
inline constexpr glm::dvec2 kHalfStepRound{0.99144486137381041, 0.13052619222005159};
static_assert(kPatchesRound == 24);

/// Patches of a full ring; odd rings are shifted by half a step.
template <class Visit>
void visitRing(const glm::dvec3& centre, const glm::dvec3& axis, double radius, const glm::dvec3& along_normal,
               double normal_out, double area, int ring, Visit&& visit) {
  const glm::dvec3 helper = std::abs(axis.z) < 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0);
  const glm::dvec3 e1 = glm::normalize(glm::cross(helper, axis)), e2 = glm::cross(axis, e1);
  glm::dvec2 at = (ring & 1) ? kHalfStepRound : glm::dvec2(1.0, 0.0);
  for (int n = 0; n < kPatchesRound; ++n) {
    const glm::dvec3 out = at.x * e1 + at.y * e2;
    visit(Patch{centre + radius * out, along_normal + normal_out * out, area / kPatchesRound});
    at = {at.x * kStepRound.x - at.y * kStepRound.y, at.y * kStepRound.x + at.x * kStepRound.y};
  }
}

/// Rings of a ball between two heights along `axis`, equal in area.
template <class Visit>
void visitZone(const glm::dvec3& centre, const glm::dvec3& axis, double ball_mm, double from_mm, double to_mm,
               int rings, Visit&& visit) {
  const double area = 2.0 * calibration::kPi * ball_mm * (to_mm - from_mm) / rings;
  for (int ring = 0; ring < rings; ++ring) {
    const double height = from_mm + (ring + 0.5) * (to_mm - from_mm) / rings;
    const double radius = std::sqrt(std::max(0.0, ball_mm * ball_mm - height * height));
    visitRing(centre + height * axis, axis, radius, height / ball_mm * axis, radius / ball_mm, area, ring, visit);
  }
}

/// Rings of a frustum from (radius, z) `from` to `to`; a disc for equal heights. `out` is its normal (radial, z).
template <class Visit>
void visitFrustum(const glm::dvec2& from, const glm::dvec2& to, const glm::dvec2& out, int rings, Visit&& visit) {
  const double length = glm::length(to - from) / rings;
  for (int ring = 0; ring < rings; ++ring) {
    const glm::dvec2 at = glm::mix(from, to, (ring + 0.5) / rings);
    visitRing({0.0, 0.0, at.y}, {0.0, 0.0, 1.0}, at.x, {0.0, 0.0, out.y}, out.x, 2.0 * calibration::kPi * at.x * length,
              ring, visit);
  }
}

/// `towards_T`, a unit vector towards the bone, and `reach_mm` matter for spheres only.
template <class Visit>
void visitHeadSurface(const BurShape& head, const glm::dvec3& towards_T, double reach_mm, Visit&& visit) {
  const double R = head.radius_mm, half = 0.5 * head.length_mm;
  const glm::dvec3 z(0.0, 0.0, 1.0);
  switch (head.kind) {
    case ShapeKind::sphere: {
      const double rim = R - std::clamp(reach_mm, 0.1 * R, 1.9 * R);
      visitZone(glm::dvec3(0.0), towards_T, R, rim, R, 16, visit);
      visitZone(glm::dvec3(0.0), towards_T, R, -R, rim, 8, visit);
      break;
    }
    case ShapeKind::capsule:
      visitZone(-half * z, -z, R, 0.0, R, 12, visit);
      visitFrustum({R, -half}, {R, half}, {1.0, 0.0}, 16, visit);
      visitZone(half * z, z, R, 0.0, R, 6, visit);
      break;
    case ShapeKind::cylinder:
      visitFrustum({0.0, -half}, {R, -half}, {0.0, -1.0}, 8, visit);
      visitFrustum({R, -half}, {R, half}, {1.0, 0.0}, 16, visit);
      visitFrustum({R, half}, {0.0, half}, {0.0, 1.0}, 6, visit);
      break;
    case ShapeKind::cone: {
      const double slant = std::hypot(R, head.length_mm);
      visitFrustum({0.0, -half}, {R, half}, glm::dvec2(head.length_mm, -R) / slant, 24, visit);
      visitFrustum({R, half}, {0.0, half}, {0.0, 1.0}, 6, visit);
      break;
    }
    case ShapeKind::revolved: {
      // About as many rings as the others have, by length along the outline; one at least a frustum.
      const assets::BurOutline outline = revolvedOutline(head);
      const auto knot = [&](std::size_t n) { return glm::dvec2(outline.radius_mm[n], outline.z_mm[n]); };
      const std::size_t last = outline.count - 1;
      double whole = 0.0;
      for (std::size_t n = 0; n < last; ++n) whole += glm::distance(knot(n), knot(n + 1));
      if (knot(0).x > 0.0) visitFrustum({0.0, -half}, knot(0), {0.0, -1.0}, 6, visit);
      for (std::size_t n = 0; n < last; ++n) {
        const glm::dvec2 way = knot(n + 1) - knot(n);
        const double length = glm::length(way);
        if (!(length > 0.0)) continue;
        const int rings = std::max(1, static_cast<int>(std::lround(24.0 * length / whole)));
        visitFrustum(knot(n), knot(n + 1), glm::dvec2(way.y, -way.x) / length, rings, visit);
      }
      if (knot(last).x > 0.0) visitFrustum(knot(last), {0.0, half}, {0.0, 1.0}, 6, visit);
      break;
    }
  }
}

}  // namespace haptics
