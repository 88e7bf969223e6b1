#include "haptics/bone/bur_coverage.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "calibration/geometry/pose.h"
#include "haptics/bone/face_share_body.h"
#include "haptics/bone/voxel_sphere.h"

namespace haptics {
namespace {

using calibration::isFinite;
using calibration::kPi;

/// The lens of voxel_sphere.h for a bur larger than the voxel; clamped, it is the whole ball or nothing.
AxialShare<double> largeSphere(double R, double eta, const glm::dvec3& p) {
  const double outer = R + eta, inner = R - eta, away = std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
  const double least = away < inner ? inner : away, d = least > outer ? outer : least;
  const double gap = outer - d, per_2d = 0.5 / d, height = eta - (d * d - R * R + eta * eta) * per_2d;
  const double per_ball = 3.0 / (4.0 * kPi * eta * eta * eta);
  const double lens = per_ball * kPi / 6.0 * per_2d * gap * gap * (d * (d + 2.0 * outer) - 3.0 * inner * inner);
  const double cap = per_ball * kPi / 3.0 * height * height * (3.0 * eta - height);
  return {lens, cap, cap * p.z};
}

/// A sphere of a voxel or two: the lens with all its branches.
AxialShare<double> smallSphere(double R, double eta, const glm::dvec3& p) {
  const double d = glm::length(p), per_ball = 3.0 / (4.0 * kPi * eta * eta * eta);
  const Lens lens = lensOfSpheres(R, eta, d);
  const double radial = d > 0.0 ? per_ball * lens.moment / d : 0.0;
  return {per_ball * lens.volume, radial, radial * p.z};
}

OutlineFoot<double> sideFoot(const BurCoverage& bur, double rho, double z) {
  OutlineFoot<double> foot{1e300, 0.0, 0.0, 0.0, 0.0};
  for (int n = 0; n < bur.segments; ++n) foot = nearerFoot(bur.segment[static_cast<std::size_t>(n)], rho, z, foot);
  return foot;
}

/// Direction across a segment of the outline, outwards.
struct Across {
  double out, up;
};
/// Beyond every voxel of a volume.
constexpr double kFar = 1e6;

/// Segments of an outline in voxels, with normals and curvatures at the knots.
void setSegments(const BurShape& shape, double per_mm, BurCoverage& bur) {
  const assets::BurOutline outline = revolvedOutline(shape);
  std::array<double, assets::kMostKnots> rho{}, z{};
  std::size_t count = 0;
  for (std::size_t n = 0; n < outline.count; ++n) {
    const double r = outline.radius_mm[n] * per_mm, h = outline.z_mm[n] * per_mm;
    if (count > 0 && std::hypot(r - rho[count - 1], h - z[count - 1]) < 1e-9) continue;
    rho[count] = r, z[count] = h, ++count;
  }
  if (count < 2) return;
  const std::size_t pieces = count - 1;
  const bool flat_low = rho[0] > 0.0, flat_high = rho[pieces] > 0.0;
  std::array<double, assets::kMostKnots> length{}, bend{};
  std::array<Across, assets::kMostKnots> across{}, normal{};
  for (std::size_t n = 0; n < pieces; ++n) {
    length[n] = std::hypot(rho[n + 1] - rho[n], z[n + 1] - z[n]);
    across[n] = {(z[n + 1] - z[n]) / length[n], (rho[n] - rho[n + 1]) / length[n]};
  }
  const auto angle = [](const Across& a, const Across& b) {
    return std::atan2(a.out * b.up - a.up * b.out, a.out * b.out + a.up * b.up);
  };
  for (std::size_t n = 0; n < count; ++n) {
    if (n == 0 || n == pieces) {
      // A round end's normal is the axis; a flat end's side meets it at an edge and is straight.
      const Across& beside = across[n == 0 ? 0 : pieces - 1];
      const bool flat = n == 0 ? flat_low : flat_high;
      const double half_length = 0.5 * length[n == 0 ? 0 : pieces - 1];
      normal[n] = flat ? beside : Across{0.0, n == 0 ? -1.0 : 1.0};
      const double turn = n == 0 ? angle(normal[n], beside) : angle(beside, normal[n]);
      bend[n] = flat ? beside.out / rho[n] : 2.0 * turn / half_length;
    } else {
      const Across sum{across[n - 1].out + across[n].out, across[n - 1].up + across[n].up};
      const double long_as = std::hypot(sum.out, sum.up);
      normal[n] = {sum.out / long_as, sum.up / long_as};
      bend[n] = angle(across[n - 1], across[n]) / (0.5 * (length[n - 1] + length[n])) + normal[n].out / rho[n];
    }
  }
  bur.segments = static_cast<int>(pieces);
  for (std::size_t n = 0; n < pieces; ++n) {
    const double per_length = 1.0 / length[n];
    bur.segment[n] = {rho[n],
                      z[n],
                      -across[n].up,
                      across[n].out,
                      length[n],
                      n == 0 && flat_low ? -kFar : 0.0,
                      n + 1 == pieces && flat_high ? kFar : length[n],
                      normal[n].out,
                      normal[n].up,
                      (normal[n + 1].out - normal[n].out) * per_length,
                      (normal[n + 1].up - normal[n].up) * per_length,
                      bend[n],
                      (bend[n + 1] - bend[n]) * per_length};
  }
  bur.end_low = flat_low ? bur.half : kFar;
  bur.end_high = flat_high ? bur.half : kFar;
  // Of the edge from which a voxel reaches farthest.
  bur.side_cos = 1.0, bur.side_sin = 0.0;
  for (const auto& [is_flat, side] : {std::pair(flat_low, across[0]), std::pair(flat_high, across[pieces - 1])})
    if (is_flat && side.out < bur.side_cos) bur.side_cos = side.out, bur.side_sin = std::abs(side.up);
}

VoxelShare shareOfPart(const BurCoverage& bur, const glm::dvec3& p) {
  const AxialShare<double> share = [&] {
    switch (bur.kind) {
      case ShapeKind::sphere:
        return bur.radius < 2.0 ? smallSphere(bur.radius, bur.eta, p) : largeSphere(bur.radius, bur.eta, p);
      case ShapeKind::capsule:
        return shareOfFaces<kCapsuleFaces>(bur, p.x, p.y, p.z, 1e-12);
      case ShapeKind::cylinder:
        return shareOfFaces<kCylinderFaces>(bur, p.x, p.y, p.z, 1e-12);
      case ShapeKind::cone:
        return shareOfFaces<kConeFaces>(bur, p.x, p.y, p.z, 1e-12);
      case ShapeKind::revolved: {
        const double rho = std::sqrt(p.x * p.x + p.y * p.y);
        return shareOfRevolved(sideFoot(bur, rho, p.z), bur.end_low, bur.end_high, bur.eta, rho, p.z, 1e-12);
      }
    }
    return AxialShare<double>{};
  }();
  return {share.fraction, {share.radial * p.x, share.radial * p.y, share.axial}};
}

/// Largest extent of the touched voxels along a direction.
double touchedReach(const BurCoverage& bur, double cos_axis) {
  const double more = bur.voxel_reach, high = bur.half + more, c = std::clamp(cos_axis, -1.0, 1.0),
               s = std::sqrt(1.0 - c * c);
  switch (bur.kind) {
    case ShapeKind::sphere:
    case ShapeKind::capsule:
      return bur.radius + more + std::abs(c) * bur.half;
    case ShapeKind::cylinder:
      return s * (bur.radius + more) + std::abs(c) * high;
    case ShapeKind::cone: {
      const double base = (more + (high + bur.half) * bur.side_sin) / bur.side_cos;
      const double tip = more * (1.0 - bur.side_sin) / bur.side_cos;
      return std::max(s * base + c * high, s * tip - c * high);
    }
    case ShapeKind::revolved: {
      // Every knot moved as far as an edge's voxels reach.
      const double wider = more * (1.0 + bur.side_sin) / bur.side_cos;
      double reach = 0.0;
      for (int n = 0; n <= bur.segments; ++n) {
        const OutlineSegment<double>& segment = bur.segment[static_cast<std::size_t>(n < bur.segments ? n : n - 1)];
        const double along = n < bur.segments ? 0.0 : segment.length;
        reach = std::max(reach, s * (segment.rho + along * segment.way_rho) + c * (segment.z + along * segment.way_z));
      }
      return reach + s * wider + std::abs(c) * more;
    }
  }
  return 0.0;
}

}  // namespace

BurCoverage::BurCoverage(const assets::VolumeGrid& grid, const BurShape& shape,
                         const calibration::Pose<calibration::Patient, calibration::Tool>& X_PT, int margin) noexcept
    : centre(grid.indexFromPoint(X_PT.translation_mm)),
      kind(shape.kind),
      radius(shape.radius_mm / grid.spacing_mm),
      half(shape.kind == ShapeKind::sphere ? 0.0 : 0.5 * shape.length_mm / grid.spacing_mm) {
  const glm::dmat3 to_P = glm::mat3_cast(X_PT.rotation);
  to_T = glm::transpose(to_P);
  const bool flat = kind == ShapeKind::cylinder || kind == ShapeKind::cone || kind == ShapeKind::revolved;
  if (!(radius > 0.0) || !std::isfinite(radius) || !(half >= 0.0) || !std::isfinite(half) || (flat && half == 0.0) ||
      !isFinite(centre) || !isFinite(to_P[0]) || !isFinite(to_P[1]) || !isFinite(to_P[2]))
    return;
  const double slant = std::hypot(radius, 2.0 * half);
  side_sin = radius / slant;
  side_cos = 2.0 * half / slant;
  if (kind == ShapeKind::revolved) {
    setSegments(shape, 1.0 / grid.spacing_mm, *this);
    if (segments == 0) return;
  }

  // A ball that is not small against the head meets more than one face: use smaller balls.
  const double thinnest = flat ? std::min(radius, half) : radius;
  if (kind != ShapeKind::sphere)
    parts = static_cast<int>(std::clamp(std::ceil(3.0 * kVoxelSphereRadius / thinnest), 1.0, 4.0));
  eta = kVoxelSphereRadius / parts;
  voxel_reach = eta + 0.5 * std::sqrt(3.0) * (1.0 - 1.0 / parts);

  glm::dvec3 low, high;
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = centre[axis] - touchedReach(*this, -to_P[2][axis]);
    high[axis] = centre[axis] + touchedReach(*this, to_P[2][axis]);
  }
  box = {grid, low, high, margin};
}

double BurCoverage::beyondFaces(const glm::dvec3& p_T) const {
  const double high = std::abs(p_T.z) - half;
  switch (kind) {
    case ShapeKind::sphere:
      return glm::length(p_T) - radius;
    case ShapeKind::capsule:
      return glm::length(glm::dvec3(p_T.x, p_T.y, std::max(0.0, high))) - radius;
    case ShapeKind::cylinder:
      return std::max(std::sqrt(p_T.x * p_T.x + p_T.y * p_T.y) - radius, high);
    case ShapeKind::cone:
      return std::max(std::sqrt(p_T.x * p_T.x + p_T.y * p_T.y) * side_cos - (p_T.z + half) * side_sin, high);
    case ShapeKind::revolved: {
      // Outside the cylinder about the head that is enough.
      const double rho = std::sqrt(p_T.x * p_T.x + p_T.y * p_T.y), outer = std::max(rho - radius, high);
      if (outer > 6.0) return outer;
      return std::max({sideFoot(*this, rho, p_T.z).distance, -p_T.z - end_low, p_T.z - end_high});
    }
  }
  return 0.0;
}

VoxelShare BurCoverage::shareAt(glm::ivec3 ijk) const {
  const glm::dvec3 place = positionInTool(ijk);
  if (parts == 1) return shareOfPart(*this, place);
  const double beyond = beyondFaces(place);
  if (beyond >= voxel_reach) return {};
  if (beyond <= -voxel_reach) return {1.0, place};
  VoxelShare sum;
  for (int part = 0; part < parts * parts * parts; ++part) {
    const glm::dvec3 at{part % parts, part / parts % parts, part / (parts * parts)};
    const glm::dvec3 offset = (at + 0.5) / static_cast<double>(parts) - 0.5;
    const VoxelShare share = shareOfPart(*this, place + to_T * offset);
    sum.fraction += share.fraction;
    sum.moment += share.moment;
  }
  const double per_part = 1.0 / (parts * parts * parts);
  return {sum.fraction * per_part, sum.moment * per_part};
}

HeadShape BurCoverage::kernelShape() const {
  HeadShape head{};
  head.kind = static_cast<int>(kind);
  head.radius = static_cast<float>(radius);
  head.half = static_cast<float>(half);
  head.side_sin = static_cast<float>(side_sin);
  head.side_cos = static_cast<float>(side_cos);
  head.eta = static_cast<float>(eta);
  head.end_low = static_cast<float>(end_low);
  head.end_high = static_cast<float>(end_high);
  head.segments = segments;
  for (int n = 0; n < segments; ++n) {
    const OutlineSegment<double>& from = segment[static_cast<std::size_t>(n)];
    const auto f = [](double value) { return static_cast<float>(value); };
    head.segment[n] = {f(from.rho),     f(from.z),    f(from.way_rho),  f(from.way_z), f(from.length),
                       f(from.first),   f(from.last), f(from.out),      f(from.up),    f(from.more_out),
                       f(from.more_up), f(from.bend), f(from.more_bend)};
  }
  for (int n = 0; n < 64; ++n) {
    const glm::dvec3 place = to_T * glm::dvec3(n & 3, n >> 2 & 3, n >> 4);
    head.x[n] = static_cast<float>(place.x);
    head.y[n] = static_cast<float>(place.y);
    head.z[n] = static_cast<float>(place.z);
  }
  return head;
}

}  // namespace haptics
