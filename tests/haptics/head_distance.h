// How far a place is from the surface of a cutting head, negative inside: in the half-plane of rho and z, by the
// outline's straight edges and arcs. Slow and obvious. Frame T, mm.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "haptics/tool/bur_shape.h"

namespace haptics {

/// From `p` to the edge between two corners of the outline.
inline double edgeDistance_mm(const glm::dvec2& from, const glm::dvec2& to, const glm::dvec2& p) {
  const glm::dvec2 along = to - from;
  const double part = std::clamp(glm::dot(p - from, along) / glm::dot(along, along), 0.0, 1.0);
  return glm::distance(p, from + part * along);
}

inline double headDistance_mm(const BurShape& head, const calibration::Point<calibration::Tool>& p_T) {
  const double R = head.radius_mm, half = 0.5 * head.length_mm;
  const glm::dvec2 p{std::hypot(p_T.mm.x, p_T.mm.y), p_T.mm.z};
  const glm::dvec2 rim{R, half}, top{0.0, half}, bottom{0.0, -half}, foot{R, -half};
  switch (head.kind) {
    case ShapeKind::sphere:
    case ShapeKind::capsule:
      return glm::length(glm::dvec2(p.x, p.y - std::clamp(p.y, -half, half))) - R;
    case ShapeKind::cylinder: {
      const double away =
          std::min({edgeDistance_mm(top, rim, p), edgeDistance_mm(rim, foot, p), edgeDistance_mm(foot, bottom, p)});
      return p.x < R && std::abs(p.y) < half ? -away : away;
    }
    case ShapeKind::cone: {
      const double away = std::min(edgeDistance_mm(top, rim, p), edgeDistance_mm(rim, bottom, p));
      return std::abs(p.y) < half && p.x < R * (p.y + half) / head.length_mm ? -away : away;
    }
    case ShapeKind::revolved: {
      // Inside: the outline is crossed once on the way out.
      const assets::BurOutline outline = revolvedOutline(head);
      std::vector<glm::dvec2> corners{bottom};
      for (std::size_t n = 0; n < outline.count; ++n) corners.emplace_back(outline.radius_mm[n], outline.z_mm[n]);
      corners.push_back(top);
      double away = 1e300;
      int crossed = 0;
      for (std::size_t n = 0; n + 1 < corners.size(); ++n) {
        const glm::dvec2 &a = corners[n], &b = corners[n + 1];
        if (a == b) continue;
        away = std::min(away, edgeDistance_mm(a, b, p));
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) ++crossed;
      }
      return crossed % 2 == 1 ? -away : away;
    }
  }
  return 0.0;
}

}  // namespace haptics
