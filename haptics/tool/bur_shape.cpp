#include "haptics/tool/bur_shape.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "calibration/geometry/units.h"

namespace haptics {
namespace {

using calibration::kPi;

/// A point of the half-plane (rho, z), or a direction in it.
using Profile = glm::dvec2;

struct ProfileDistance {
  double distance;
  Profile gradient;
};

/// Nearest to a rounded rod along z: distance to its core line, less its radius.
ProfileDistance toRod(const Profile& p, double radius, double half_core) {
  const Profile from_core{p.x, p.y - std::clamp(p.y, -half_core, half_core)};
  const double away = glm::length(from_core);
  return {away - radius, away > 0.0 ? from_core / away : Profile{0.0, 0.0}};
}

/// A straight edge of the outline with its normal out of the body.
struct Edge {
  Profile from, to, normal;
};

Profile nearestOn(const Edge& edge, const Profile& p) {
  const Profile along = edge.to - edge.from;
  const double length2 = glm::dot(along, along);
  const double part = length2 > 0.0 ? std::clamp(glm::dot(p - edge.from, along) / length2, 0.0, 1.0) : 0.0;
  return edge.from + part * along;
}

/// To a convex outline: inside the nearest edge's plane counts, outside the nearest point of an edge.
template <std::size_t N>
ProfileDistance toEdges(const Profile& p, const std::array<Edge, N>& edges) {
  double deepest = -1e300;
  const Edge* nearest = nullptr;
  for (const Edge& edge : edges) {
    const double height = glm::dot(p - edge.from, edge.normal);
    if (height <= deepest) continue;
    deepest = height;
    nearest = &edge;
  }
  if (deepest <= 0.0) return {deepest, nearest->normal};
  double least = 1e300;
  Profile away{0.0};
  for (const Edge& edge : edges) {
    const Profile offset = p - nearestOn(edge, p);
    const double distance = glm::length(offset);
    if (distance >= least) continue;
    least = distance;
    away = distance > 0.0 ? offset / distance : nearest->normal;
  }
  return {least, away};
}

ProfileDistance toOutline(const BurShape& shape, const Profile& p) {
  const double R = shape.radius_mm, half = 0.5 * shape.length_mm;
  switch (shape.kind) {
    case ShapeKind::sphere:
      return toRod(p, R, 0.0);
    case ShapeKind::capsule:
      return toRod(p, R, half);
    case ShapeKind::cylinder:
      return toEdges<3>(p, {{{{0.0, half}, {R, half}, {0.0, 1.0}},
                             {{R, half}, {R, -half}, {1.0, 0.0}},
                             {{R, -half}, {0.0, -half}, {0.0, -1.0}}}});
    case ShapeKind::cone: {
      const double slant = std::hypot(R, shape.length_mm);
      return toEdges<2>(
          p, {{{{0.0, half}, {R, half}, {0.0, 1.0}},
               {{R, half}, {0.0, -half}, slant > 0.0 ? Profile{shape.length_mm, -R} / slant : Profile{1.0, 0.0}}}});
    }
  }
  return {0.0, {0.0, 0.0}};
}

double within(double value, double least, double most, double otherwise) {
  return std::isfinite(value) ? std::clamp(value, least, most) : otherwise;
}

}  // namespace

BurShape sanitised(const BurShape& shape) noexcept {
  const BurShape defaults;
  BurShape safe;
  safe.kind = shape.kind <= ShapeKind::cone ? shape.kind : defaults.kind;
  safe.radius_mm = within(shape.radius_mm, kLeastBurRadius_mm, kLargestBurRadius_mm, defaults.radius_mm);
  const double least = safe.kind == ShapeKind::capsule ? 0.0 : kLeastHeadLength_mm;
  safe.length_mm = safe.kind == ShapeKind::sphere ? 0.0 : within(shape.length_mm, least, kLongestHead_mm, least);
  return safe;
}

SurfaceDistance surfaceDistance(const BurShape& shape, const calibration::Point<calibration::Tool>& p_T) noexcept {
  const double rho = std::hypot(p_T.mm.x, p_T.mm.y);
  const ProfileDistance profile = toOutline(shape, {rho, p_T.mm.z});
  const double radial = rho > 0.0 ? profile.gradient.x / rho : 0.0;
  return {profile.distance, {{radial * p_T.mm.x, radial * p_T.mm.y, profile.gradient.y}}};
}

double volume_mm3(const BurShape& shape) noexcept {
  const double disc = kPi * shape.radius_mm * shape.radius_mm, ball = 4.0 / 3.0 * disc * shape.radius_mm;
  switch (shape.kind) {
    case ShapeKind::sphere:
      return ball;
    case ShapeKind::capsule:
      return ball + disc * shape.length_mm;
    case ShapeKind::cylinder:
      return disc * shape.length_mm;
    case ShapeKind::cone:
      return disc * shape.length_mm / 3.0;
  }
  return 0.0;
}

double halfHeight_mm(const BurShape& shape) noexcept {
  if (shape.kind == ShapeKind::sphere) return shape.radius_mm;
  return 0.5 * shape.length_mm + (shape.kind == ShapeKind::capsule ? shape.radius_mm : 0.0);
}

double reach_mm(const BurShape& shape, double cos_axis) noexcept {
  const double c = std::clamp(cos_axis, -1.0, 1.0), s = std::sqrt(1.0 - c * c), half = 0.5 * shape.length_mm;
  switch (shape.kind) {
    case ShapeKind::sphere:
      return shape.radius_mm;
    case ShapeKind::capsule:
      return shape.radius_mm + std::abs(c) * half;
    case ShapeKind::cylinder:
      return s * shape.radius_mm + std::abs(c) * half;
    case ShapeKind::cone:
      return std::max(s * shape.radius_mm + c * half, -c * half);
  }
  return 0.0;
}

}  // namespace haptics
