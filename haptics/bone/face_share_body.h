// Overlap of a voxel's ball with a head: in double for bone/bur_coverage, in float for the kernels (bone/head_kernels).
// Included once by each source, with internal linkage and no other header, so that the instruction sets share no code.
// Written for the compiler's vectoriser. Formulae: bone/bur_coverage.
#pragma once

namespace haptics {
namespace {

/// Covered fraction of a voxel and its first moment: (radial x, radial y, axial).
template <class Real>
struct AxialShare {
  Real fraction, radial, axial;
};

/// Fraction of the ball behind a face, and the inward shift of its middle times that.
template <class Real>
struct FaceShare {
  Real fraction, shift;
};
template <class Real>
inline FaceShare<Real> behindFace(Real distance, Real bend, Real eta, Real per_eta) {
  constexpr Real kOne = 1;
  const Real raw = -distance * per_eta, low = raw < -kOne ? -kOne : raw, t = low > kOne ? kOne : low;
  const Real rim = kOne - t * t;
  return {Real(0.25) * (Real(2) + Real(3) * t - t * t * t) - bend * rim * rim, Real(0.1875) * eta * rim * rim};
}

/// 3/32 of the curvature times eta; curvature is limited to that of the ball.
template <class Real>
inline Real bendOf(Real curvature, Real eta) {
  const Real round = curvature * eta;
  return Real(0.09375) * (round < Real(1) ? round : Real(1));
}

template <class Real>
inline Real atLeast(Real value, Real least) {
  return value > least ? value : least;
}

inline float rootOf(float x) { return __builtin_sqrtf(x); }
inline double rootOf(double x) { return __builtin_sqrt(x); }

inline constexpr int kCapsuleFaces = 1, kCylinderFaces = 2, kConeFaces = 3, kRevolvedFaces = 4;  // ShapeKind

/// Nearest place of an outline so far: squared distance, signed distance outwards, normal and curvature there.
template <class Real>
struct OutlineFoot {
  Real square, distance, out, up, bend;
};

/// A segment is nearer, or not. Its normal and curvature run from knot to knot, so that no edge is felt between two
/// segments that meet at a small angle.
template <class Segment, class Real>
inline OutlineFoot<Real> nearerFoot(const Segment& segment, Real rho, Real z, const OutlineFoot<Real>& so_far) {
  constexpr Real kZero = 0;
  const Real across = rho - segment.rho, along = z - segment.z;
  const Real t = across * segment.way_rho + along * segment.way_z,
             off = across * segment.way_z - along * segment.way_rho;
  const Real low = t < segment.first ? segment.first : t, at = low > segment.last ? segment.last : low, beyond = t - at;
  const Real square = off * off + beyond * beyond, away = rootOf(square), side = off < kZero ? -away : away;
  const Real from = t < kZero ? kZero : t, part = from > segment.length ? segment.length : from;
  const bool nearer = square < so_far.square;
  return {nearer ? square : so_far.square, nearer ? side : so_far.distance,
          nearer ? segment.out + part * segment.more_out : so_far.out,
          nearer ? segment.up + part * segment.more_up : so_far.up,
          nearer ? segment.bend + part * segment.more_bend : so_far.bend};
}

/// A voxel under a revolved head whose nearest place of the outline is `foot`: the side, cut by flat ends.
template <class Real>
inline AxialShare<Real> shareOfRevolved(const OutlineFoot<Real>& foot, Real end_low, Real end_high, Real eta, Real rho,
                                        Real z, Real tiny) {
  constexpr Real kZero = 0, kOne = 1;
  const Real per_eta = kOne / eta, per_rho = kOne / atLeast(rho, tiny), up = z < kZero ? -kOne : kOne;
  const Real over = z < kZero ? -z - end_low : z - end_high;
  const FaceShare<Real> end = behindFace(over, kZero, eta, per_eta);
  const FaceShare<Real> side = behindFace(foot.distance, bendOf(foot.bend, eta), eta, per_eta);
  const Real fraction = side.fraction * end.fraction, shift = side.shift * end.fraction;
  return {fraction, fraction - shift * foot.out * per_rho,
          fraction * z - side.fraction * end.shift * up - shift * foot.up};
}

/// A voxel at (x, y, z) in T under a capsule, cylinder or cone with radius, half, side_sin, side_cos and eta.
template <int kKind, class Head, class Real>
inline AxialShare<Real> shareOfFaces(const Head& head, Real x, Real y, Real z, Real tiny) {
  constexpr Real kZero = 0, kOne = 1, kHalf = Real(0.5);
  const Real eta = head.eta, per_eta = kOne / eta, R = head.radius, half = head.half;
  const Real high = z < kZero ? -z : z, up = z < kZero ? -kOne : kOne;
  if constexpr (kKind == kCapsuleFaces) {
    const Real over = high - half, dz = over > kZero ? over * up : kZero;
    const Real away = rootOf(x * x + y * y + dz * dz);
    // One curvature on the rod, two on its ends; a ball on the seam has some of each.
    const Real raw = kHalf + kHalf * over * per_eta, low = raw < kZero ? kZero : raw, end = low > kOne ? kOne : low;
    const FaceShare<Real> face = behindFace(away - R, bendOf((kOne + end) / R, eta), eta, per_eta);
    const Real shift = face.shift / atLeast(away, tiny);
    return {face.fraction, face.fraction - shift, face.fraction * z - shift * dz};
  }
  const Real rho = rootOf(x * x + y * y), per_rho = kOne / atLeast(rho, tiny);
  const FaceShare<Real> end = behindFace(high - half, kZero, eta, per_eta);
  if constexpr (kKind == kCylinderFaces) {
    const FaceShare<Real> side = behindFace(rho - R, bendOf(kOne / R, eta), eta, per_eta);
    const Real fraction = side.fraction * end.fraction;
    return {fraction, fraction - side.shift * end.fraction * per_rho, fraction * z - side.fraction * end.shift * up};
  }
  // Cone: the slanted side, and two ends, of which the lower one rounds off the tip.
  const Real distance = rho * head.side_cos - (z + half) * head.side_sin;
  const Real foot = atLeast(rho - distance * head.side_cos, tiny);
  const FaceShare<Real> side = behindFace(distance, bendOf(head.side_cos / foot, eta), eta, per_eta);
  const Real fraction = side.fraction * end.fraction, shift = side.shift * end.fraction;
  return {fraction, fraction - shift * head.side_cos * per_rho,
          fraction * z - side.fraction * end.shift * up + shift * head.side_sin};
}

}  // namespace
}  // namespace haptics
