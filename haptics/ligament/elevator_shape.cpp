#include "haptics/ligament/elevator_shape.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace haptics {
namespace {

/// Signed distance to a convex polygon, counter-clockwise, and its gradient.
struct Flat {
  double mm;
  glm::dvec2 out;
};

Flat distanceToOutline(const std::array<glm::dvec2, ElevatorShape::kCorners>& corner, const glm::dvec2& p) noexcept {
  Flat inside{-1e9, {1.0, 0.0}};
  double least2 = 1e18;
  glm::dvec2 way(0.0);
  for (std::size_t n = 0; n < corner.size(); ++n) {
    const glm::dvec2 from = corner[n], along = corner[(n + 1) % corner.size()] - from;
    const double length2 = glm::dot(along, along);
    if (length2 == 0.0) continue;
    const glm::dvec2 to = p - from, out = glm::dvec2(along.y, -along.x) / std::sqrt(length2);
    if (const double beyond = glm::dot(to, out); beyond > inside.mm) inside = {beyond, out};
    const glm::dvec2 nearest = to - std::clamp(glm::dot(to, along) / length2, 0.0, 1.0) * along;
    if (const double d2 = glm::dot(nearest, nearest); d2 < least2) {
      least2 = d2;
      way = nearest;
    }
  }
  if (inside.mm <= 0.0) return inside;
  const double mm = std::sqrt(least2);
  return {mm, way / mm};
}

ElevatorShape::Distance nearer(const ElevatorShape::Distance& a, const ElevatorShape::Distance& b) {
  return a.mm <= b.mm ? a : b;
}

void addPoint(ElevatorShape& shape, const glm::dvec3& p_T_mm, double radius_mm) {
  assert(shape.points < ElevatorShape::kMostPoints);
  const auto n = static_cast<std::size_t>(shape.points++);
  shape.point_T_mm[n] = p_T_mm;
  shape.point_radius_mm[n] = radius_mm;
}

void addPoint(ElevatorShape& shape, const glm::dvec3& p_T_mm) {
  addPoint(shape, p_T_mm, shape.edge_radius_mm);
  shape.reach_mm = std::max(shape.reach_mm, glm::distance(p_T_mm, shape.middle_T_mm) + shape.edge_radius_mm);
}

constexpr double kShank_mm = 35.0;
constexpr double kShankRadius_mm = 1.2;  // behind the blade, where it tapers

void addShank(ElevatorShape& shape, double from_mm) {
  shape.shank_radius_mm = kShankRadius_mm;
  shape.shank_from_mm = from_mm + kShankRadius_mm;
  shape.shank_to_mm = from_mm + kShank_mm - kShankRadius_mm;
  for (int n = 0; n < 4; ++n) addPoint(shape, {0.0, 0.0, shape.shank_from_mm + 2.0 * n}, kShankRadius_mm);
}

ElevatorShape straight(double width_mm, double thickness_mm, double length_mm) {
  constexpr double kEdge_mm = 0.15, kTipThickness_mm = 0.5;
  ElevatorShape s;
  const double tip = 0.5 * kTipThickness_mm - kEdge_mm, root = 0.5 * thickness_mm - kEdge_mm;
  const double low = kEdge_mm, high = length_mm - kEdge_mm;
  s.corner_mm = {{{-tip, low}, {tip, low}, {root, high}, {-root, high}}};
  s.across = 0;
  s.half_mm = 0.5 * width_mm - kEdge_mm;
  s.edge_radius_mm = kEdge_mm;
  s.middle_T_mm = {0.0, 0.0, 0.5 * length_mm};

  constexpr int kAlong = 6;
  for (int n = 0; n < kAlong; ++n) {
    const double share = n / (kAlong - 1.0), y = tip + share * (root - tip), z = low + share * (high - low);
    for (const double x : {-s.half_mm, s.half_mm})
      for (const double face : {-y, y}) addPoint(s, {x, face, z});
  }
  for (const double x : {-s.half_mm / 3.0, s.half_mm / 3.0})
    for (const double face : {-tip, tip}) addPoint(s, {x, face, low});
  addShank(s, length_mm);
  return s;
}

/// `side`: -1 left, 1 right.
ElevatorShape cryer(double side) {
  constexpr double kLength_mm = 9.0, kBase_mm = 4.5, kThickness_mm = 1.2, kEdge_mm = 0.3;
  // The blade stands at 100 degrees to the shank.
  constexpr double kSine = 0.984807753012208, kCosine = -0.17364817766693;
  ElevatorShape s;
  const glm::dvec2 to_tip(kCosine, side * kSine), up(kSine, -side * kCosine);  // (z, x)
  const glm::dvec2 base(-kLength_mm * kCosine, 0.0);
  const glm::dvec2 tip = base + (kLength_mm - kEdge_mm) * to_tip, in = base + kEdge_mm * to_tip;
  const glm::dvec2 half = (0.5 * kBase_mm - kEdge_mm) * up;
  const glm::dvec2 low = in - half, high = in + half;
  s.corner_mm = side > 0.0 ? std::array{tip, tip, low, high} : std::array{tip, tip, high, low};
  s.across = 1;
  s.half_mm = 0.5 * kThickness_mm - kEdge_mm;
  s.edge_radius_mm = kEdge_mm;
  const glm::dvec2 middle = 0.5 * (tip + in);
  s.middle_T_mm = {middle.y, 0.0, middle.x};

  for (const double y : {-s.half_mm, s.half_mm}) {
    addPoint(s, {tip.y, y, tip.x});
    constexpr int kAlong = 6;
    for (int n = 1; n <= kAlong; ++n)
      for (const glm::dvec2& end : {low, high}) {
        const glm::dvec2 at = tip + n / static_cast<double>(kAlong) * (end - tip);
        addPoint(s, {at.y, y, at.x});
      }
  }
  addShank(s, base.x);
  return s;
}

}  // namespace

ElevatorShape::Distance ElevatorShape::distanceAt(const glm::dvec3& p_T_mm) const noexcept {
  const glm::dvec2 p = across == 0 ? glm::dvec2(p_T_mm.y, p_T_mm.z) : glm::dvec2(p_T_mm.z, p_T_mm.x);
  const Flat flat = distanceToOutline(corner_mm, p);
  const double side = p_T_mm[across] < 0.0 ? -1.0 : 1.0, over_mm = side * p_T_mm[across] - half_mm;
  // An outline drawn along a line: outside both the way round the edge, else the larger.
  double mm = std::max(flat.mm, over_mm);
  double of_flat = flat.mm > over_mm ? 1.0 : 0.0, of_side = 1.0 - of_flat;
  if (flat.mm > 0.0 && over_mm > 0.0) {
    mm = std::sqrt(flat.mm * flat.mm + over_mm * over_mm);
    of_flat = flat.mm / mm;
    of_side = over_mm / mm;
  }
  glm::dvec3 out =
      across == 0 ? glm::dvec3(0.0, of_flat * flat.out) : of_flat * glm::dvec3(flat.out.y, 0.0, flat.out.x);
  out[across] = of_side * side;
  const Distance blade{mm - edge_radius_mm, out};

  const glm::dvec3 arm(p_T_mm.x, p_T_mm.y, p_T_mm.z - std::clamp(p_T_mm.z, shank_from_mm, shank_to_mm));
  const double length_mm = glm::length(arm);
  const Distance shank{length_mm - shank_radius_mm, length_mm > 0.0 ? arm / length_mm : glm::dvec3(0.0, 1.0, 0.0)};
  return nearer(blade, shank);
}

ElevatorShape elevatorShape(ElevatorKind kind) noexcept {
  switch (kind) {
    case ElevatorKind::straight_34s:
      return straight(4.0, 1.3, 9.0);
    case ElevatorKind::cryer_left:
      return cryer(-1.0);
    case ElevatorKind::cryer_right:
      return cryer(1.0);
    default:
      return straight(3.0, 1.0, 8.0);
  }
}

}  // namespace haptics
