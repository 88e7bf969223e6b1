#include "haptics/contact/points.h"

#include <algorithm>
#include <cmath>

#include "calibration/geometry/units.h"
#include "haptics/contact/cap.h"
#include "haptics/contact/field_sample.h"
#include "haptics/tool/flat_overlap.h"

namespace haptics {
namespace {

using calibration::kPi;

/// Sums over the points in bone, weighted by the solid fraction. Frame T, mm.
struct Cloud {
  double all = 0.0;             ///< number of points
  double count = 0.0;           ///< in bone
  double dense = 0.0;           ///< count, weighted by tissue
  double beside = 0.0;          ///< count, next to a capsule's rod, not at its ends
  glm::dvec3 position{0.0};     ///< sum of positions
  glm::dvec3 from_axis{0.0};    ///< sum of vectors from the nearest point of the axis or its segment
  glm::dvec3 out_of_axis{0.0};  ///< the same, normalised
  glm::dvec3 outwards{0.0};     ///< of a revolved head: sum of the normals of its nearest faces
};

/// Points of Kronecker's lattice in the head's box (steps of powers of 1 / 1.2207, the root of x^4 = x + 1), those
/// inside.
/// Radius of a revolved head at a height, and the outward normal (out, up) of its side there.
struct Girth {
  double radius, out, up;
};
Girth girthAt(const assets::BurOutline& outline, double z) {
  std::size_t n = 0;
  while (n + 2 < outline.count && z > outline.z_mm[n + 1]) ++n;
  const double r0 = outline.radius_mm[n], r1 = outline.radius_mm[n + 1], z0 = outline.z_mm[n];
  const double way = std::max(1e-9, outline.z_mm[n + 1] - z0), length = std::hypot(r1 - r0, way);
  return {std::max(0.0, r0 + (z - z0) / way * (r1 - r0)), way / length, (r0 - r1) / length};
}

/// Normal of the nearest face of a revolved head from a place inside it.
glm::dvec3 nearestFace(const assets::BurOutline& outline, double half, const glm::dvec3& position_T) {
  const double rho = std::hypot(position_T.x, position_T.y);
  const Girth girth = girthAt(outline, position_T.z);
  const double to_side = (girth.radius - rho) * girth.out;
  const bool flat_low = outline.radius_mm[0] > 0.0, flat_high = outline.radius_mm[outline.count - 1] > 0.0;
  const bool below = position_T.z < 0.0;
  if ((below ? flat_low : flat_high) && half - std::abs(position_T.z) < to_side) return {0.0, 0.0, below ? -1.0 : 1.0};
  const double per_rho = girth.out / std::max(rho, 1e-9);
  return {per_rho * position_T.x, per_rho * position_T.y, girth.up};
}

template <class Visit>
void visitSamplePoints(const BurShape& head, Visit&& visit) {
  constexpr glm::dvec3 kStep(0.81917251339616442, 0.67104360670378920, 0.54970047790197026);
  const double R = head.radius_mm, half = halfHeight_mm(head);
  const bool revolved = head.kind == ShapeKind::revolved, upright = revolved || head.kind == ShapeKind::cone;
  const assets::BurOutline outline = revolved ? revolvedOutline(head) : assets::BurOutline{};
  const double box_mm3 = 8.0 * R * R * half;
  const int tried = std::min(8 * kSamplePoints, static_cast<int>(0.5 * kSamplePoints * box_mm3 / volume_mm3(head)));
  glm::dvec3 unit(0.5);
  for (int n = 0; n < tried; ++n) {
    unit = glm::fract(unit + kStep);
    const glm::dvec3 position_T = (2.0 * unit - 1.0) * glm::dvec3(R, R, half);
    const double radius2 = position_T.x * position_T.x + position_T.y * position_T.y;
    const double beyond = std::max(0.0, std::abs(position_T.z) - 0.5 * head.length_mm);
    bool inside = radius2 <= R * R;
    if (head.kind == ShapeKind::sphere) inside = radius2 + position_T.z * position_T.z <= R * R;
    if (head.kind == ShapeKind::capsule) inside = radius2 + beyond * beyond <= R * R;
    if (head.kind == ShapeKind::cone) inside = std::sqrt(radius2) * head.length_mm <= R * (position_T.z + half);
    if (revolved) {
      const double girth = girthAt(outline, position_T.z).radius;
      inside = radius2 <= girth * girth;
    }
    if (!inside) continue;
    visit(position_T);
    visit(glm::dvec3(-position_T.x, -position_T.y, upright ? position_T.z : -position_T.z));
  }
}

Cloud cloudIn(const ToolInBone& at) {
  Cloud cloud;
  const double half = 0.5 * at.head.length_mm;
  const ToolSampler sampler(at.bodies, at.X_PT);
  const bool revolved = at.head.kind == ShapeKind::revolved;
  const assets::BurOutline outline = revolved ? revolvedOutline(at.head) : assets::BurOutline{};
  visitSamplePoints(at.head, [&](const glm::dvec3& position_T) {
    cloud.all += 1.0;
    const FieldSample sample = sampler.at(position_T);
    if (sample.solid <= 0.0) return;
    cloud.count += sample.solid;
    cloud.dense += sample.solid * at.tissue.factor[std::min<std::size_t>(sample.label, assets::kTissueCount - 1)];
    cloud.position += sample.solid * position_T;
    if (revolved) {
      cloud.outwards += sample.solid * nearestFace(outline, half, position_T);
      return;
    }
    glm::dvec3 from_axis(position_T.x, position_T.y, 0.0);
    if (at.head.kind == ShapeKind::capsule) {
      from_axis.z = position_T.z - std::clamp(position_T.z, -half, half);
      if (from_axis.z == 0.0) cloud.beside += sample.solid;
    }
    cloud.from_axis += sample.solid * from_axis;
    const double length = glm::length(from_axis);
    if (length > 0.0) cloud.out_of_axis += sample.solid / length * from_axis;
  });
  return cloud;
}

/// Depth and direction of a cloud in flat bone, by the rule of its shape.
struct Reading {
  double depth_mm = 0.0;
  double slope = 1.0;     ///< d depth / d true depth
  glm::dvec3 out_T{0.0};  ///< at most 1 long
  double one_sided = 1.0;
};

/// A vector over its length, at least over a twentieth of `scale`.
glm::dvec3 directed(const glm::dvec3& v, double scale) { return v / std::max({glm::length(v), 0.05 * scale, 1e-12}); }

/// Depth of a round side of this length and radius for a shallow volume: V = (4/3) sqrt(2 R) h^3/2 L.
double sideDepth_mm(double volume_mm3, double R, double length_mm) {
  return std::pow(volume_mm3 / std::max(1e-9, 4.0 / 3.0 * std::sqrt(2.0 * R) * length_mm), 2.0 / 3.0);
}
/// Centroid of a circle segment h deep, as a parabola's: 3/5 of the depth from its tip.
double segmentCentre_mm(double R, double h) { return std::max(0.1 * R, R - 0.6 * h); }
double capCentre_mm(double R, double h) {
  const double deep = std::min(h, 1.5 * R);
  return 0.75 * (2.0 * R - deep) * (2.0 * R - deep) / (3.0 * R - deep);
}
/// Weight of the shorter of two ways out.
double shorterShare(double this_mm, double other_mm) {
  const double a = this_mm * this_mm, b = other_mm * other_mm;
  return b * b / std::max(1e-30, a * a + b * b);
}

Reading readBall(const BurShape& head, const Cloud& cloud, double volume, double spacing_mm) {
  // Linear interpolation of a face one voxel soft smears depth by half a voxel, a sum over voxel spheres by 0.4.
  const double R = head.radius_mm, h = equivalentDepth_mm(R, volume, 0.5 / 0.4 * spacing_mm);
  if (h <= 0.0) return {};
  const double flat = capMoment_mm4(R, h) / volume, found = glm::length(cloud.position) / cloud.count;
  return {h * std::sqrt(1.0 - h / (3.0 * R)), (1.0 - 0.5 * h / R) / std::sqrt(1.0 - h / (3.0 * R)),
          -directed(cloud.position, 0.2 * R * cloud.count), flat > 0.0 ? found / flat : 0.0};
}

Reading readCapsule(const BurShape& head, const Cloud& cloud, double volume) {
  const double R = head.radius_mm, beside = cloud.beside / cloud.count;
  const double side = sideDepth_mm(beside * volume, R, head.length_mm);
  const double end = std::sqrt((1.0 - beside) * volume / (kPi * R));
  const double flat = beside * segmentCentre_mm(R, side) + (1.0 - beside) * capCentre_mm(R, end);
  return {beside * side + (1.0 - beside) * end, 1.0, -directed(cloud.from_axis, 0.2 * R * cloud.count),
          glm::length(cloud.from_axis) / cloud.count / flat};
}

Reading readCylinder(const BurShape& head, const Cloud& cloud, double volume) {
  const double R = head.radius_mm, L = head.length_mm;
  const double side = sideDepth_mm(volume, R, L), end = volume / (kPi * R * R);
  // Distance to free it along the axis and across, from the centroid of the cloud.
  const double across = glm::length(cloud.from_axis) / cloud.count, along = cloud.position.z / cloud.count;
  const double share = shorterShare(L - 2.0 * std::abs(along), (R - across) / 0.6);
  const glm::dvec3 out =
      -(1.0 - share) * directed(cloud.from_axis, 0.2 * R * cloud.count) - share * directed({0.0, 0.0, along}, 0.2 * L);
  const double one_sided = (1.0 - share) * across / segmentCentre_mm(R, side) +
                           share * std::abs(along) / std::max(0.05 * L, 0.5 * (L - end));
  return {(1.0 - share) * side + share * end, 1.0, out / std::max(1.0, glm::length(out)), one_sided};
}

Reading readCone(const BurShape& head, const Cloud& cloud, double volume) {
  const double R = head.radius_mm, L = head.length_mm, slant = std::hypot(R, L);
  const double cosine = L / slant, sine = R / slant, tangent = R / L;
  // By its tip, side or base: the tip's points surround the axis, the side's are on one side.
  const double tip = std::cbrt(3.0 * volume / (kPi * tangent * tangent));
  const double side = cosine / L * std::pow(9.0 * volume / (8.0 * std::sqrt(2.0 * tangent)), 2.0 / 3.0);
  const double aside = glm::length(cloud.out_of_axis) / cloud.count, along = cloud.position.z / cloud.count;
  const double by_side = std::min(1.0, 4.0 * aside * aside);
  const double cone = by_side * side + (1.0 - by_side) * tip, base = volume / (kPi * R * R);
  const double share = shorterShare(std::max(0.0, L - 2.0 * along), cone);
  const glm::dvec3 out =
      -(1.0 - share) * glm::normalize(cosine * cloud.out_of_axis / cloud.count - glm::dvec3(0.0, 0.0, sine)) -
      share * glm::dvec3(0.0, 0.0, 1.0);
  return {(1.0 - share) * cone + share * base, 1.0, out / std::max(1.0, glm::length(out)), 1.0};
}

/// By the normals of the nearest faces: those of a flat contact agree, those all round cancel.
Reading readRevolved(const BurShape& head, const Cloud& cloud, double volume) {
  const double agree = glm::length(cloud.outwards) / cloud.count;
  const glm::dvec3 out = -directed(cloud.outwards, 0.2 * cloud.count);
  const double length = glm::length(out);
  const double depth = flatDepth_mm(head, volume, length > 0.0 ? out.z / length : 0.0);
  return {depth, 1.0, out, std::min(1.0, 2.0 * agree)};
}

Reading readCloud(const BurShape& head, const Cloud& cloud, double volume, double spacing_mm) {
  switch (head.kind) {
    case ShapeKind::sphere:
      return readBall(head, cloud, volume, spacing_mm);
    case ShapeKind::capsule:
      return readCapsule(head, cloud, volume);
    case ShapeKind::cylinder:
      return readCylinder(head, cloud, volume);
    case ShapeKind::cone:
      return readCone(head, cloud, volume);
    case ShapeKind::revolved:
      return readRevolved(head, cloud, volume);
  }
  return {};
}

}  // namespace

Contact pointsContact(const PointsParameters& parameters, const ToolInBone& at, const LawState& state) noexcept {
  const Cloud cloud = cloudIn(at);
  Contact contact;
  if (cloud.count <= 0.0) return contact;
  const double share = cloud.count / cloud.all;
  contact.volume_mm3 = share * volume_mm3(at.head);
  const Reading reading = readCloud(at.head, cloud, contact.volume_mm3, at.bodies.spacing_mm());
  contact.depth_mm = reading.depth_mm;
  contact.normal_P.xyz = at.X_PT.rotation * reading.out_T;
  // No direction wholly inside bone.
  contact.one_sided = std::min(1.0, reading.one_sided) * std::clamp((1.0 - share) / 0.15, 0.0, 1.0);
  contact.tissue_factor = cloud.dense / cloud.count;
  const double stiffness_N_per_mm = parameters.stiffness_N_per_mm * state.density.with(contact.tissue_factor);
  contact.force_P_N = stiffness_N_per_mm * contact.depth_mm * contact.normal_P;
  contact.torque_P_Nmm.xyz = glm::cross(at.X_PT.rotation * (cloud.position / cloud.count), contact.force_P_N.xyz);
  if (at.head.kind == ShapeKind::sphere) contact.torque_P_Nmm = {};
  contact.stiffness_N_per_mm = stiffness_N_per_mm * reading.slope;
  return contact;
}

void updatePointsState(const Contact& contact, LawState& state) noexcept {
  if (contact.depth_mm > 0.0) state.density.push(contact.tissue_factor);
}

}  // namespace haptics
