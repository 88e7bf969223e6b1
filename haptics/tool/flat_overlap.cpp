#include "haptics/tool/flat_overlap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

#include "calibration/geometry/units.h"

namespace haptics {
namespace {

using calibration::kPi;

/// Gauss-Legendre, 16 points on -1..1, the positive half (Abramowitz & Stegun 25.4).
constexpr std::size_t kHalf = 8, kPoints = 2 * kHalf;
constexpr std::array<double, kHalf> kNode = {0.0950125098376374402, 0.2816035507792589132, 0.4580167776572273863,
                                             0.6178762444026437484, 0.7554044083550030339, 0.8656312023878317439,
                                             0.9445750230732325761, 0.9894009349916499326};
constexpr std::array<double, kHalf> kWeight = {0.1894506104550684963, 0.1826034150449235889, 0.1691565193950025382,
                                               0.1495959888165767321, 0.1246289712555338720, 0.0951585116824927848,
                                               0.0622535239386478929, 0.0271524594117540949};

/// Nodes and weights on -1..1, condensed towards both ends by (3 x - x^3)/2: the square roots at the ends of a slice
/// become polynomials.
struct Rule {
  std::array<double, kPoints> node{}, weight{};
};
constexpr Rule kRule = [] {
  Rule rule;
  for (std::size_t i = 0; i < kPoints; ++i) {
    const std::size_t n = i < kHalf ? kHalf - 1 - i : i - kHalf;
    const double x = i < kHalf ? -kNode[n] : kNode[n];
    rule.node[i] = 0.5 * x * (3.0 - x * x);
    rule.weight[i] = kWeight[n] * 1.5 * (1.0 - x * x);
  }
  return rule;
}();

/// An interval of the axis with squared radius a + b z + c z^2.
struct Piece {
  double from, to, a, b, c;
  double radius2(double z) const { return std::max(0.0, a + z * (b + z * c)); }
};

struct Pieces {
  std::array<Piece, assets::kMostKnots> piece{};
  std::size_t count = 0;

  Pieces() = default;
  Pieces(std::initializer_list<Piece> all) {
    for (const Piece& one : all) piece[count++] = one;
  }
};

/// Frustums.
Pieces revolvedPieces(const BurShape& shape) {
  const assets::BurOutline outline = revolvedOutline(shape);
  Pieces pieces;
  for (std::size_t n = 0; n + 1 < outline.count; ++n) {
    const double from = outline.z_mm[n], to = outline.z_mm[n + 1], r = outline.radius_mm[n];
    if (!(to - from > 1e-9)) continue;
    const double slope = (outline.radius_mm[n + 1] - r) / (to - from), at_0 = r - slope * from;
    pieces.piece[pieces.count++] = {from, to, at_0 * at_0, 2.0 * at_0 * slope, slope * slope};
  }
  return pieces;
}

Pieces piecesOf(const BurShape& shape) {
  const double R = shape.radius_mm, r2 = R * R, half = 0.5 * shape.length_mm;
  switch (shape.kind) {
    case ShapeKind::sphere:
      return {{-R, R, r2, 0.0, -1.0}};
    case ShapeKind::capsule:
      return {{-half - R, -half, r2 - half * half, -2.0 * half, -1.0},
              {-half, half, r2, 0.0, 0.0},
              {half, half + R, r2 - half * half, 2.0 * half, -1.0}};
    case ShapeKind::cylinder:
      return {{-half, half, r2, 0.0, 0.0}};
    case ShapeKind::cone: {
      const double slope2 = r2 / (shape.length_mm * shape.length_mm);
      return {{-half, half, slope2 * half * half, 2.0 * slope2 * half, slope2}};
    }
    case ShapeKind::revolved:
      return revolvedPieces(shape);
  }
  return {};
}

/// The face n.p = level, n = (sin, 0, cos) in T rotated so that the normal has no y.
struct Face {
  double sin, cos, level;
};

/// Sums over slices: volume and its moments, and the area of the face.
struct Sums {
  double volume = 0.0, area = 0.0, across = 0.0, along = 0.0;
};

/// Whole discs from z0 to z1: polynomials, by Simpson's rule (exact up to z^3; z r^2 has degree 3).
void addWhole(const Piece& piece, double z0, double z1, Sums& sums) {
  const double middle = 0.5 * (z0 + z1), part = kPi * (z1 - z0) / 6.0;
  const double low = piece.radius2(z0), mid = piece.radius2(middle), high = piece.radius2(z1);
  sums.volume += part * (low + 4.0 * mid + high);
  sums.along += part * (low * z0 + 4.0 * mid * middle + high * z1);
}

/// acos(x) / sqrt(1 - x) on 0..1: interpolated at Chebyshev nodes, to 2e-12. Unlike the library's it vectorises.
constexpr std::array<double, 13> kArcCosine = {
    1.570796326793054,    -0.21460183596171,      0.08904858539088645,  -0.05079196176251237, 0.03367101688942853,
    -0.02429970723204065, 0.01831736906376591,    -0.01372154322025381, 0.009480517917836551, -0.005483192960673478,
    0.00236850970541127,  -0.0006562407128512859, 8.571846410632133e-05};

/// Discs cut by the face: segments x <= u of circles.
template <bool kAreaOnly>
void addCut(const Piece& piece, double z0, double z1, const Face& face, Sums& sums) {
  const double middle = 0.5 * (z0 + z1), half = 0.5 * (z1 - z0), per_sin = 1.0 / face.sin;
  std::array<double, kPoints> chord, segment;
  for (std::size_t i = 0; i < kPoints; ++i) {
    const double z = middle + half * kRule.node[i], u = (face.level - z * face.cos) * per_sin;
    const double r2 = piece.a + z * (piece.b + z * piece.c), room = r2 - u * u;
    chord[i] = std::sqrt(room > 0.0 ? room : 0.0);
    if constexpr (kAreaOnly) continue;
    // r^2 times the angle acos(-u/r), and u times the half chord.
    const double away = u < 0.0 ? -u : u, r = std::sqrt(r2 > 0.0 ? r2 : 0.0), safe = r > 1e-30 ? r : 1e-30;
    const double x = away < safe ? away / safe : 1.0;
    double quotient = kArcCosine.back();
    for (std::size_t n = kArcCosine.size() - 1; n-- > 0;) quotient = quotient * x + kArcCosine[n];
    const double acute = std::sqrt(1.0 - x) * quotient;
    segment[i] = r2 * (u > 0.0 ? kPi - acute : acute) + u * chord[i];
  }
  for (std::size_t i = 0; i < kPoints; ++i) {
    const double weight = half * kRule.weight[i];
    sums.area += weight * 2.0 * chord[i] * per_sin;
    if constexpr (kAreaOnly) continue;
    sums.volume += weight * segment[i];
    sums.across -= weight * 2.0 / 3.0 * chord[i] * chord[i] * chord[i];
    sums.along += weight * segment[i] * (middle + half * kRule.node[i]);
  }
}

/// Where the face crosses the profile within a piece: sin^2 r^2 = (level - z cos)^2, a quadratic in z.
std::array<double, 2> crossings(const Piece& piece, const Face& face) {
  const double s2 = face.sin * face.sin;
  const double a = s2 * piece.c - face.cos * face.cos, b = 0.5 * (s2 * piece.b) + face.level * face.cos;
  const double c = s2 * piece.a - face.level * face.level;
  const double under = b * b - a * c;
  if (under < 0.0) return {piece.from, piece.from};
  const double q = -(b + std::copysign(std::sqrt(under), b));
  double first = a != 0.0 ? q / a : piece.from, second = q != 0.0 ? c / q : piece.from;
  if (!(first <= second)) std::swap(first, second);
  return {std::clamp(first, piece.from, piece.to), std::clamp(second, piece.from, piece.to)};
}

template <bool kAreaOnly>
void addPiece(const Piece& piece, const Face& face, Sums& sums) {
  const std::array<double, 2> cross = crossings(piece, face);
  const std::array<double, 4> end = {piece.from, cross[0], cross[1], piece.to};
  for (std::size_t i = 0; i + 1 < end.size(); ++i) {
    if (!(end[i + 1] > end[i])) continue;
    // Between two crossings all slices are cut, whole or missing like the middle one.
    const double z = 0.5 * (end[i] + end[i + 1]), below = face.level - z * face.cos;
    const double edge = face.sin * std::sqrt(piece.radius2(z));
    if (std::abs(below) < edge)
      addCut<kAreaOnly>(piece, end[i], end[i + 1], face, sums);
    else if (below > 0.0 && !kAreaOnly)
      addWhole(piece, end[i], end[i + 1], sums);
  }
}

/// A face across the axis: whole discs up to one height.
void addAcross(const Piece& piece, const Face& face, Sums& sums) {
  const double at = face.level / face.cos, z = std::clamp(at, piece.from, piece.to);
  if (face.cos > 0.0 ? z > piece.from : z < piece.to)
    face.cos > 0.0 ? addWhole(piece, piece.from, z, sums) : addWhole(piece, z, piece.to, sums);
  if (at > piece.from && at <= piece.to) sums.area += kPi * piece.radius2(z);
}

/// Below it a face counts as across the axis: error 1e-7 of the volume.
constexpr double kMinSin = 1e-7;

template <bool kAreaOnly>
Sums sumsAt(const BurShape& shape, double depth_mm, double cos_axis) {
  const double cos = std::clamp(cos_axis, -1.0, 1.0), sin = std::sqrt((1.0 - cos) * (1.0 + cos));
  const Face face{sin, cos, depth_mm - reach_mm(shape, -cos)};
  const Pieces pieces = piecesOf(shape);
  Sums sums;
  for (std::size_t i = 0; i < pieces.count; ++i)
    sin > kMinSin ? addPiece<kAreaOnly>(pieces.piece[i], face, sums) : addAcross(pieces.piece[i], face, sums);
  return sums;
}

double sphereVolume_mm3(double R, double h) { return kPi * h * h * (R - h / 3.0); }

/// Volume and area at a depth in 0..fullDepth.
struct Immersed {
  double volume, area;
};
Immersed immersed(const BurShape& shape, double depth_mm, double cos_axis) {
  if (shape.kind == ShapeKind::sphere)
    return {sphereVolume_mm3(shape.radius_mm, depth_mm), kPi * depth_mm * (2.0 * shape.radius_mm - depth_mm)};
  const Sums sums = sumsAt<false>(shape, depth_mm, cos_axis);
  return {sums.volume, sums.area};
}

/// Depth of at most half the head. Steps as if V were a power of h, which it nearly is: h (volume / V)^(V / (A h)); a
/// step outside the bracket is replaced by bisection. Converges quadratically: after a step of `accuracy` its square
/// remains.
double shallowDepth(const BurShape& shape, double volume, double whole_volume, double cos_axis, double accuracy) {
  double low = 0.0, high = fullDepth_mm(shape, cos_axis), h = high * std::sqrt(volume / whole_volume);
  for (int i = 0; i < 40; ++i) {
    const Immersed at = immersed(shape, h, cos_axis);
    (at.volume < volume ? low : high) = h;
    const double power = at.area * h / at.volume;
    double next = h * std::pow(volume / at.volume, 1.0 / power);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const double step = std::abs(next - h);
    h = next;
    if (step <= accuracy * h) break;
  }
  return h;
}

constexpr double kExact = 1e-6, kClose = 1e-2;

double normalDensity(double z) { return std::exp(-0.5 * z * z) / std::sqrt(2.0 * kPi); }
double normalBelow(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

/// Near first touch: smeared V = integral of A(x) P(x < h + sigma xi) dx, with the areas evaluated once, at x = H t^2.
double touchingDepth(const BurShape& shape, double volume, double unsmeared, double cos_axis, double sigma) {
  const double reach = unsmeared + 4.0 * sigma;
  std::array<double, kPoints> x, area;
  for (std::size_t i = 0; i < kPoints; ++i) {
    const std::size_t n = i < kHalf ? kHalf - 1 - i : i - kHalf;
    const double t = 0.5 + 0.5 * (i < kHalf ? -kNode[n] : kNode[n]);
    x[i] = reach * t * t;
    area[i] = kWeight[n] * reach * t * sumsAt<true>(shape, x[i], cos_axis).area;
  }
  double h = unsmeared;
  for (int step = 0; step < 12; ++step) {
    double sum = 0.0, slope = 0.0;
    for (std::size_t i = 0; i < kPoints; ++i) {
      const double z = (h - x[i]) / sigma;
      sum += area[i] * normalBelow(z);
      slope += area[i] * normalDensity(z) / sigma;
    }
    const double change = (sum - volume) / slope;
    const double next = std::max(h - change, 0.0);
    const bool settled = std::abs(next - h) < 1e-9 * sigma;
    h = next;
    if (settled) break;
  }
  return h;
}

}  // namespace

double fullDepth_mm(const BurShape& shape, double cos_axis) noexcept {
  return reach_mm(shape, cos_axis) + reach_mm(shape, -cos_axis);
}

FlatOverlap flatOverlap(const BurShape& shape, double depth_mm, double cos_axis) noexcept {
  const double whole = fullDepth_mm(shape, cos_axis);
  if (!(depth_mm > 0.0)) return {};
  if (depth_mm >= whole) {
    return {volume_mm3(shape), 0.0, 0.0, centroid_mm(shape)};
  }
  const Sums sums = sumsAt<false>(shape, depth_mm, cos_axis);
  if (!(sums.volume > 0.0)) return {};
  return {sums.volume, sums.area, sums.across / sums.volume, sums.along / sums.volume};
}

double flatDepth_mm(const BurShape& shape, double shared_mm3, double cos_axis, double sigma_mm) noexcept {
  const double whole = volume_mm3(shape);
  if (!(shared_mm3 > 0.0)) return 0.0;
  if (shared_mm3 >= whole) return fullDepth_mm(shape, cos_axis);
  // More than half is less than half of the head seen from the other side.
  const bool beyond = shared_mm3 > 0.5 * whole;
  const double volume = beyond ? whole - shared_mm3 : shared_mm3, cos = beyond ? -cos_axis : cos_axis;
  double h = shallowDepth(shape, volume, whole, cos, sigma_mm > 0.0 ? kClose : kExact);
  if (sigma_mm > 0.0) {
    // Deep enough for the whole smear: three points of Gauss-Hermite.
    const double side = std::sqrt(3.0) * sigma_mm, deepest = fullDepth_mm(shape, cos);
    if (h < 4.0 * sigma_mm || h + side > deepest) {
      h = touchingDepth(shape, volume, h, cos, sigma_mm);
    } else {
      const Immersed less = immersed(shape, h - side, cos), more = immersed(shape, h + side, cos);
      const Immersed here = immersed(shape, h, cos);
      const double smeared = 2.0 / 3.0 * here.volume + (less.volume + more.volume) / 6.0;
      // As a power of h: a cone's tip would need a second Newton step.
      const double slope = 2.0 / 3.0 * here.area + (less.area + more.area) / 6.0;
      h *= std::pow(volume / smeared, smeared / (slope * h));
    }
  }
  h = std::clamp(h, 0.0, fullDepth_mm(shape, cos));
  return beyond ? fullDepth_mm(shape, cos) - h : h;
}

}  // namespace haptics
