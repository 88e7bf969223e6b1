#include "haptics/bone/bur_coverage.h"

#include <algorithm>
#include <cmath>

#include "calibration/geometry/finite.h"
#include "haptics/bone/face_share_body.h"
#include "haptics/bone/voxel_sphere.h"

namespace haptics {
namespace {

using calibration::isFinite;
using calibration::kPi;

/// What a voxel at (x, y, z) in T shares with the bur. Its first moment is (radial x, radial y, axial).
struct AxialShare {
  double fraction, radial, axial;
};

template <ShapeKind kKind>
inline AxialShare shareOf(const BurCoverage& bur, double x, double y, double z) {
  const double eta = bur.eta, per_eta = 1.0 / eta, R = bur.radius, half = bur.half;
  if constexpr (kKind == ShapeKind::sphere) {
    // The lens of voxel_sphere.h for a bur larger than the voxel; clamped, it is the whole ball or nothing.
    const double outer = R + eta, inner = R - eta, away = std::sqrt(x * x + y * y + z * z);
    const double least = away < inner ? inner : away, d = least > outer ? outer : least;
    const double gap = outer - d, per_2d = 0.5 / d, height = eta - (d * d - R * R + eta * eta) * per_2d;
    const double per_ball = 3.0 / (4.0 * kPi * eta * eta * eta);
    const double lens = per_ball * kPi / 6.0 * per_2d * gap * gap * (d * (d + 2.0 * outer) - 3.0 * inner * inner);
    const double cap = per_ball * kPi / 3.0 * height * height * (3.0 * eta - height);
    return {lens, cap, cap * z};
  }
  const double high = z < 0.0 ? -z : z, up = z < 0.0 ? -1.0 : 1.0;
  if constexpr (kKind == ShapeKind::capsule) {
    const double over = high - half, dz = over > 0.0 ? over * up : 0.0;
    const double away = std::sqrt(x * x + y * y + dz * dz);
    // Round one way on the rod, both ways on its ends; a ball on the seam sees some of each.
    const double raw = 0.5 + 0.5 * over * per_eta, low = raw < 0.0 ? 0.0 : raw, end = low > 1.0 ? 1.0 : low;
    const FaceShare face = behindFace(away - R, bendOf((1.0 + end) / R, eta), eta, per_eta);
    const double shift = face.shift / atLeast(away, 1e-12);
    return {face.fraction, face.fraction - shift, face.fraction * z - shift * dz};
  }
  const double rho = std::sqrt(x * x + y * y), per_rho = 1.0 / atLeast(rho, 1e-12);
  const FaceShare end = behindFace(high - half, 0.0, eta, per_eta);
  if constexpr (kKind == ShapeKind::cylinder) {
    const FaceShare side = behindFace(rho - R, bendOf(1.0 / R, eta), eta, per_eta);
    const double fraction = side.fraction * end.fraction;
    return {fraction, fraction - side.shift * end.fraction * per_rho, fraction * z - side.fraction * end.shift * up};
  }
  // Cone: the slanted side, and two ends, of which the lower one rounds off the tip.
  const double distance = rho * bur.side_cos - (z + half) * bur.side_sin;
  const double foot = atLeast(rho - distance * bur.side_cos, 1e-12);
  const FaceShare side = behindFace(distance, bendOf(bur.side_cos / foot, eta), eta, per_eta);
  const double fraction = side.fraction * end.fraction, shift = side.shift * end.fraction;
  return {fraction, fraction - shift * bur.side_cos * per_rho,
          fraction * z - side.fraction * end.shift * up + shift * bur.side_sin};
}

/// A sphere no larger than a voxel or two: the lens with all its branches.
AxialShare smallSphere(double R, double eta, const glm::dvec3& p) {
  const double d = glm::length(p), per_ball = 3.0 / (4.0 * kPi * eta * eta * eta);
  const Lens lens = lensOfSpheres(R, eta, d);
  const double radial = d > 0.0 ? per_ball * lens.moment / d : 0.0;
  return {per_ball * lens.volume, radial, radial * p.z};
}

bool isSmallSphere(const BurCoverage& bur) { return bur.kind == ShapeKind::sphere && bur.radius < 2.0; }

VoxelShare shareOfPart(const BurCoverage& bur, const glm::dvec3& p) {
  const AxialShare share = [&] {
    switch (bur.kind) {
      case ShapeKind::sphere:
        return isSmallSphere(bur) ? smallSphere(bur.radius, bur.eta, p)
                                  : shareOf<ShapeKind::sphere>(bur, p.x, p.y, p.z);
      case ShapeKind::capsule:
        return shareOf<ShapeKind::capsule>(bur, p.x, p.y, p.z);
      case ShapeKind::cylinder:
        return shareOf<ShapeKind::cylinder>(bur, p.x, p.y, p.z);
      case ShapeKind::cone:
        return shareOf<ShapeKind::cone>(bur, p.x, p.y, p.z);
    }
    return AxialShare{};
  }();
  return {share.fraction, {share.radial * p.x, share.radial * p.y, share.axial}};
}

/// How far along a direction a voxel may lie that is within reach of every face.
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
  const bool flat = kind == ShapeKind::cylinder || kind == ShapeKind::cone;
  if (!(radius > 0.0) || !std::isfinite(radius) || !(half >= 0.0) || !std::isfinite(half) || (flat && half == 0.0) ||
      !isFinite(centre) || !isFinite(to_P[0]) || !isFinite(to_P[1]) || !isFinite(to_P[2]))
    return;
  const double slant = std::hypot(radius, 2.0 * half);
  side_sin = radius / slant;
  side_cos = 2.0 * half / slant;

  // A ball that is not small against the head sees more of it than one face: smaller balls, then.
  const double thinnest = flat ? std::min(radius, half) : radius;
  if (kind != ShapeKind::sphere)
    parts = static_cast<int>(std::clamp(std::ceil(3.0 * kVoxelSphereRadius / thinnest), 1.0, 4.0));
  eta = kVoxelSphereRadius / parts;
  voxel_reach = eta + 0.5 * std::sqrt(3.0) * (1.0 - 1.0 / parts);

  // Clipped as doubles: a wild pose must not overflow an index.
  for (int axis = 0; axis < 3; ++axis) {
    const double cos = to_P[2][axis];
    const double low = std::max(static_cast<double>(-margin), centre[axis] - touchedReach(*this, -cos));
    const double high =
        std::min(static_cast<double>(grid.size[axis] - 1 + margin), centre[axis] + touchedReach(*this, cos));
    if (!(low <= high)) {
      last = first - 1;
      return;
    }
    first[axis] = static_cast<int>(std::ceil(low));
    last[axis] = static_cast<int>(std::floor(high));
  }
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
  for (int n = 0; n < 64; ++n) {
    const glm::dvec3 place = to_T * glm::dvec3(n & 3, n >> 2 & 3, n >> 4);
    head.x[n] = static_cast<float>(place.x);
    head.y[n] = static_cast<float>(place.y);
    head.z[n] = static_cast<float>(place.z);
  }
  return head;
}

}  // namespace haptics
