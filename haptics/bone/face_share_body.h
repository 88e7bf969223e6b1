// A voxel's ball against one face of a head, in double for the slow way (bone/bur_coverage) and in float for the
// kernels. Included once by each source, with internal linkage and no header, so that nothing of it is shared between
// instruction sets. Written for the compiler's vectoriser.
#pragma once

namespace haptics {
namespace {

/// How much of the ball is behind the face, and how far its middle shifts inwards times that.
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

/// 3/32 of the curvature times eta; a face rounder than the ball is taken for one as round.
template <class Real>
inline Real bendOf(Real curvature, Real eta) {
  const Real round = curvature * eta;
  return Real(0.09375) * (round < Real(1) ? round : Real(1));
}

template <class Real>
inline Real atLeast(Real value, Real least) {
  return value > least ? value : least;
}

}  // namespace
}  // namespace haptics
