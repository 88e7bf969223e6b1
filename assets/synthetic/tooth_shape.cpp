#include "assets/synthetic/tooth_shape.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "calibration/geometry/units.h"

namespace assets {
namespace {

constexpr double kToothLattice_mm = 0.2;
constexpr double kPulpLattice_mm = 0.25;
constexpr double kMargin_mm = 1.6;

/// Height of the occlusal surface: upper envelope of cusps and ridges; the valleys are the fissures.
double occlusalHeight_mm(const ToothParameters& tooth, const glm::dvec2& p) {
  constexpr double kRounding_mm = 0.45, kFissure_mm = 0.16;
  double height_mm = -100.0;
  for (const CuspParameters& cusp : tooth.cusps) {
    const glm::dvec2 d = p - cusp.tip_mm;
    const double r = std::sqrt(glm::dot(d, d) + kRounding_mm * kRounding_mm) - kRounding_mm;
    const double ridge = std::cos(4.0 * (std::atan2(d.y, d.x) - cusp.ridge_rad));
    const double slope = cusp.slope * (1.0 - 0.30 * ridge * smoothStep(0.0, 1.5, r));
    height_mm = smoothMax(height_mm, cusp.height_mm - slope * r, kFissure_mm);
  }
  for (const RidgeParameters& ridge : tooth.ridges) {
    const double t = nearestOnSegment(p, ridge.from_mm, ridge.to_mm);
    const double r = glm::distance(p, ridge.from_mm + t * (ridge.to_mm - ridge.from_mm));
    const double rounded = std::sqrt(r * r + 0.3 * 0.3) - 0.3;
    height_mm = smoothMax(height_mm, ridge.height_mm - 0.9 * rounded, kFissure_mm);
  }
  return height_mm;
}

double crown_mm(const ToothParameters& tooth, const glm::dvec3& p) {
  // Half widths at this height, quadrant by quadrant.
  const double mesiodistal_mm = profile(p.x > 0.0 ? tooth.mesial_mm : tooth.distal_mm, p.z);
  const double buccolingual_mm = profile(p.y > 0.0 ? tooth.buccal_mm : tooth.lingual_mm, p.z);

  // Side: superellipse, pinched along the developmental grooves.
  const double u = std::abs(p.x) / mesiodistal_mm, v = std::abs(p.y) / buccolingual_mm;
  double radius = std::pow(std::pow(u, tooth.squareness) + std::pow(v, tooth.squareness), 1.0 / tooth.squareness);
  const double direction_rad = std::atan2(p.y, p.x);
  double pinch = 0.0;
  for (const GrooveParameters& groove : tooth.grooves) {
    const double turn = std::remainder(direction_rad - groove.direction_rad, 2.0 * calibration::kPi) / groove.width_rad;
    pinch += groove.depth * std::exp(-turn * turn);
  }
  radius *= 1.0 + pinch * smoothStep(1.2, 4.6, p.z);
  const double side_mm = (radius - 1.0) * std::min(mesiodistal_mm, buccolingual_mm);

  // Below every fissure the occlusal surface is far.
  const double top_mm = p.z < 2.5 ? -2.0 : 0.82 * (p.z - occlusalHeight_mm(tooth, {p.x, p.y}));
  const double bottom_mm = -2.2 - p.z;
  return smoothMax(smoothMax(side_mm, top_mm, 0.8), bottom_mm, 0.5);
}

glm::dvec2 rootCentre_mm(const RootParameters& root, double t) {
  const glm::dvec2 straight = glm::mix(root.neck_mm, root.apex_mm, t * t * (1.6 - 0.6 * t));
  return straight + glm::dvec2(root.bow_mm * std::sin(calibration::kPi * std::min(t, 1.0)), 0.0);
}

double root_mm(const RootParameters& root, const glm::dvec3& p) {
  const double t = std::clamp(-p.z / root.length_mm, 0.0, 1.1);
  const glm::dvec2 d = glm::dvec2(p.x, p.y) - rootCentre_mm(root, t);
  glm::dvec2 half_mm = glm::mix(root.neck_half_mm, root.apex_half_mm, std::pow(t, 1.15));

  // A long hollow on the broad faces.
  const double waist = std::exp(-std::pow(d.y / (0.45 * half_mm.y), 2.0));
  half_mm.x *= 1.0 - root.hollow * waist * smoothStep(0.05, 0.3, t);

  const double side_mm = (glm::length(d / half_mm) - 1.0) * std::min(half_mm.x, half_mm.y);
  const double end_mm = -root.length_mm - p.z;
  return smoothMax(smoothMax(side_mm, end_mm, 2.2), p.z - 1.5, 0.5);
}

double outerField_mm(const ToothParameters& tooth, const glm::dvec3& p) {
  if (p.z < -4.0 && tooth.roots.size() == 1) return root_mm(tooth.roots[0], p);
  const double distance_mm = p.z < -4.0 ? 1e3 : crown_mm(tooth, p);
  if (p.z > 3.5) return distance_mm;
  double roots_mm = 1e3;
  for (const RootParameters& root : tooth.roots) roots_mm = smoothMin(roots_mm, root_mm(root, p), 1.3);
  return smoothMin(distance_mm, roots_mm, 1.0);
}

/// Chamber under the crown, horns towards the cusps, canals down the roots.
double pulpField_mm(const ToothParameters& tooth, const glm::dvec3& p) {
  const double width_mm = tooth.mesial_mm[1].value, depth_mm = tooth.buccal_mm[1].value;
  const glm::dvec3 half(0.52 * width_mm * tooth.pulp, 0.46 * depth_mm * tooth.pulp, 1.25 * tooth.pulp);
  const glm::dvec3 q = (p - glm::dvec3(0.0, 0.0, 0.4)) / half;
  double distance_mm =
      (std::pow(std::pow(std::abs(q.x), 3.0) + std::pow(std::abs(q.y), 3.0) + std::pow(std::abs(q.z), 3.0), 1.0 / 3.0) -
       1.0) *
      std::min({half.x, half.y, half.z});

  for (const CuspParameters& cusp : tooth.cusps) {
    const glm::dvec3 from(0.3 * cusp.tip_mm, 0.6), to(0.66 * cusp.tip_mm, 0.42 * cusp.height_mm);
    const double t = nearestOnSegment(p, from, to);
    const double radius_mm = tooth.pulp * (0.62 - 0.42 * t);
    distance_mm = smoothMin(distance_mm, glm::distance(p, from + t * (to - from)) - radius_mm, 0.6);
  }

  for (const RootParameters& root : tooth.roots) {
    const double t = std::clamp(-p.z / root.length_mm, 0.0, 0.985);
    const double spread_mm = root.canals == 2 ? 0.5 * glm::mix(root.neck_half_mm.y, root.apex_half_mm.y, t) : 0.0;
    const double outside_mm = std::max({0.0, -p.z - 0.985 * root.length_mm, p.z});
    const double radius_mm = tooth.pulp * (0.62 * (1.0 - t) * (1.0 - 0.3 * t) + 0.16);
    for (int canal = 0; canal < root.canals; ++canal) {
      const glm::dvec2 d =
          glm::dvec2(p.x, p.y) - rootCentre_mm(root, t) - glm::dvec2(0.0, canal == 0 ? -spread_mm : spread_mm);
      const double flat = root.canals == 1 ? 1.6 : 1.0;
      const double across_mm = std::hypot(d.x, d.y / flat);
      distance_mm = smoothMin(
          distance_mm,
          std::hypot(std::max(across_mm - radius_mm, 0.0), outside_mm) + std::min(across_mm - radius_mm, 0.0), 0.5);
    }
  }
  return distance_mm;
}

BoundingBox boxOf(const ToothParameters& tooth) {
  const auto largest = [](const auto& parts, auto member) {
    double value = 0.0;
    for (const auto& part : parts) value = std::max(value, part.*member);
    return value + kMargin_mm;
  };
  const auto widest = [&](const std::vector<ProfileKnot>& knots) { return largest(knots, &ProfileKnot::value); };
  return {{-widest(tooth.distal_mm), -widest(tooth.lingual_mm), -largest(tooth.roots, &RootParameters::length_mm)},
          {widest(tooth.mesial_mm), widest(tooth.buccal_mm), largest(tooth.cusps, &CuspParameters::height_mm)}};
}

}  // namespace

ToothShape::ToothShape(const ToothParameters& parameters)
    : outer_(boxOf(parameters), kToothLattice_mm,
             [&parameters](const glm::dvec3& p) { return outerField_mm(parameters, p); }),
      pulp_(boxOf(parameters), kPulpLattice_mm,
            [&parameters](const glm::dvec3& p) { return pulpField_mm(parameters, p); }) {
  outer_.redistance();
}

double ToothShape::heightAboveCervix_mm(const glm::dvec3& p) const {
  const double direction_rad = std::atan2(p.y, p.x);
  return p.z - 0.55 * std::cos(2.0 * direction_rad) * smoothStep(0.5, 3.0, std::hypot(p.x, p.y));
}

double ToothShape::core_mm(const glm::dvec3& p, double outer_mm) const {
  const double height_mm = heightAboveCervix_mm(p);
  static constexpr ProfileKnot kEnamel_mm[] = {{0.0, 0.0}, {0.8, 0.45}, {2.0, 1.0}, {4.0, 1.5}, {5.5, 2.0}, {7.0, 2.3}};
  if (height_mm <= 0.0) return outer_mm;
  return outer_mm + profile(kEnamel_mm, height_mm);
}

template <int position>
static const ToothShape& shapeOnce() {
  static const ToothShape kShape(lowerToothParameters(position));
  return kShape;
}

const ToothShape& lowerToothShape(int position) {
  constexpr std::array kShapes{shapeOnce<1>, shapeOnce<2>, shapeOnce<3>, shapeOnce<4>,
                               shapeOnce<5>, shapeOnce<6>, shapeOnce<7>, shapeOnce<8>};
  return kShapes[static_cast<std::size_t>(position - 1)]();
}

}  // namespace assets
