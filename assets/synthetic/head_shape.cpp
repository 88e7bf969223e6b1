#include "assets/synthetic/head_shape.h"

#include "assets/synthetic/face_frames.h"
#include "assets/synthetic/mouth_interior.h"

namespace assets {
namespace {

using glm::dvec3;

// Skull, forehead, cheekbones, brows: hard and slow shapes.
double skull(const dvec3& k, const dvec3& m) {
  double d = ellipsoid(k, {0, 78, 106}, {74, 95, 80});
  d = smoothMin(d, ellipsoid(m, {0, 8, 112}, {52, 26, 40}), 30.0);
  d = smoothMin(d, ellipsoid(m, {0, 50, 44}, {60, 57, 58}), 24.0);
  d = smoothMin(d, ellipsoid(m, {0, 13, 17}, {29, 25, 24}), 18.0);
  d = smoothMin(d, ellipsoid(m, {41, 17, 46}, {19, 16, 13}), 18.0);
  d = smoothMin(d, capsule(m, {50, 24, 51}, {61, 62, 57}, 7, 7), 18.0);
  d = smoothMin(d, capsule(m, {10, -7.5, 87}, {38, 2, 88}, 7.5, 6), 14.0);
  return smoothMin(d, ball(m, {0, -5, 88}, 11), 14.0);
}

// Lower jaw with chin, body, angle and the muscle over it; `q` and `m` are |x| folded, mandible and skull.
double lowerFace(const MouthOpening& opening, const dvec3& q, const dvec3& m) {
  double d = ellipsoid(q, {0, 9, -28}, {19, 18, 18});
  d = smoothMin(d, ellipsoid(q, {7, 3, -33}, {9, 10, 9}), 12.0);
  d = smoothMin(d, capsule(q, {12, 9, -29}, {41, 60, -27}, 15, 14), 14.0);
  d = smoothMin(d, capsule(q, {41, 60, -27}, {45, 78, -14}, 14, 12), 12.0);
  d = smoothMin(d, capsule(q, {26, 34, -10}, {37, 60, -6}, 17, 17), 16.0);
  const auto in_skull = [&](const dvec3& p) { return opening.skullFromMandible(p); };
  const dvec3 angle = in_skull({46, 76, -12});
  d = smoothMin(d, capsule(m, angle, {54, 60, 46}, 12, 9), 18.0);
  // Tissue between the jaws: lip muscle, cheek.
  d = smoothMin(d, capsule(m, {0, 12, 14}, in_skull({0, 12, -14}), 22, 18), 16.0);
  d = smoothMin(d, capsule(m, {28, 22, 28}, in_skull({24, 26, -14}), 19, 17), 16.0);
  return smoothMin(d, capsule(m, {39, 36, 36}, in_skull({38, 50, -10}), 18, 15), 20.0);
}

double neck(const dvec3& k) {
  double d = capsule(k, {0, 96, 10}, {0, 118, -150}, 46, 50);
  return smoothMin(d, capsule(k, {0, 44, -36}, {0, 84, -70}, 20, 30), 30.0);
}

double eyes(double d, const dvec3& m) {
  // Orbit, then the eyeball under closed lids.
  d = smoothMax(d, -ellipsoid(m, {29, -16, 73}, {17, 13.5, 11.5}), 14.0);
  const double ball_mm = ellipsoid(m, {31.5, 5.5, 71.5}, {14.0, 13.5, 12.6});
  d = smoothMin(d, ball_mm, 5.0);
  // Crease above, lash line below, both arcs round the ball.
  const double across = (m.x - 31.5) / 15.0;
  const double arch = 1.0 - across * across;
  if (std::abs(across) < 1.25 && m.y < 14.0) {
    const double near_ball = 1.0 - smoothStep(1.0, 4.0, std::abs(ball_mm));
    const double crease_z = 70.5 + 8.2 * std::max(arch, -0.3);
    const double lash_z = 69.6 - 4.6 * std::max(arch, -0.3);
    const auto groove = [&](double z, double width) { return std::exp(-std::pow((m.z - z) / width, 2.0)); };
    const double ends = 1.0 - smoothStep(0.95, 1.2, std::abs(across));
    d += near_ball * ends *
         (0.75 * groove(crease_z, 0.9) + 0.85 * groove(lash_z, 0.7) - 0.35 * groove(lash_z + 1.9, 1.3) -
          0.3 * groove(lash_z - 1.7, 1.2));
  }
  // Bag under the eye.
  return d + 0.7 * bump(m, {24, -2, 59}, {9, 8, 2.4}) - 0.5 * bump(m, {28, -2, 63.5}, {11, 8, 3});
}

double nose(double d, const dvec3& m) {
  double n = capsule(m, {0, -9.5, 82}, {0, -16.5, 62}, 5.6, 5.8);
  n = smoothMin(n, capsule(m, {0, -16.5, 62}, {0, -25, 37}, 5.8, 6.2), 6.0);
  n = smoothMin(n, ellipsoid(m, {2.6, -26.5, 32.5}, {6.0, 6.4, 6.6}), 6.0);
  n = smoothMin(n, capsule(m, {4, -6, 70}, {9, -10, 38}, 6, 7.5), 9.0);
  // Wings flow from the tip round the nostrils into the cheek.
  const double wing = smoothMin(ellipsoid(m, {11.2, -15.5, 28.8}, {6.2, 9.0, 6.6}),
                                capsule(m, {7.5, -22, 28.5}, {13.2, -10.5, 27.0}, 3.6, 3.8), 3.0);
  n = smoothMin(n, wing, 5.5);
  d = smoothMin(d, n, 8.0);
  d = smoothMin(d, capsule(m, {0, -26.5, 27.5}, {0, -12, 22.5}, 3.0, 4.5), 4.0);
  // The groove behind the wing.
  d += 0.9 * std::exp(-std::pow((wing - 1.4) / 1.2, 2.0)) * smoothStep(-17.0, -9.0, m.y) * smoothStep(20.0, 25.0, m.z) *
       smoothStep(41.0, 33.0, m.z);
  // Nostrils.
  const dvec3 hole = rotatedAboutX(m - dvec3(6.7, -18.0, 22.8), -0.25);
  const dvec3 splayed(hole.x - 0.3 * hole.y, hole.y, hole.z);
  return smoothMax(d, -ellipsoid(splayed, {0, 0, 0}, {3.0, 6.0, 5.2}), 2.0);
}

// From the lower jaw to the upper one: its upper end higher by so much, its lower end where it is.
double stretched(const dvec3& p, const dvec3& centre, const dvec3& radii, double raised_mm) {
  const dvec3 half(0.0, 0.0, 0.5 * raised_mm);
  return ellipsoid(p, centre + half, radii + half);
}

// From front to back: lips, and the middles of the retracted cheek and the cavity.
constexpr double kLips_mm = -14.0, kCheek_mm = 27.0, kCavity_mm = 34.0;

}  // namespace

HeadShape::HeadShape(const MouthOpening& opening)
    : opening_(opening),
      cheek_raised_mm_(opening.raised_mm(kCheek_mm)),
      cavity_raised_mm_(opening.raised_mm(kCavity_mm)),
      rim_(
          [this](double x, double z) {
            // Sphere tracing from the front.
            dvec3 p(x, -70.0, z);
            for (int step = 0; step < 200; ++step) {
              const double d = closed_mm(p);
              if (d < 0.01) break;
              p.y += 0.7 * d;
            }
            return p.y;
          },
          opening.raised_mm(kLips_mm)) {}

double HeadShape::closed_mm(const dvec3& p) const {
  const dvec3 k = opening_.skullFromMandible(p);
  // Mirrored at the midline, rounded against a crease.
  const double folded = std::sqrt(p.x * p.x + 2.0);
  const dvec3 m(folded, k.y, k.z);
  const dvec3 q(folded, p.y, p.z);
  double d = smoothMin(skull(k, m), lowerFace(opening_, q, m), 16.0);
  // The retracted cheek.
  d = smoothMin(d, stretched(p, {36, 27, 15}, {21, 24, 24}, cheek_raised_mm_), 16.0);
  d = smoothMin(d, neck(k), 22.0);
  if (k.y < 60.0 && k.z > 10.0) d = nose(eyes(d, m), m);
  // Chin fold, naso-labial fold, philtrum.
  d += 1.6 * bump(q, {0, -8, -15}, {14, 9, 3.2});
  d += 1.0 * std::exp(-std::pow(capsule(m, {18.5, -10, 27}, {31, -1, 4}, 0, 0) / 3.0, 2.0));
  d += 0.9 * std::exp(-std::pow(capsule(k, {0, -14, 20}, {0, -15, 8}, 0, 0) / 2.6, 2.0));
  return d;
}

double HeadShape::cavity_mm(const dvec3& p) const {
  const dvec3 k = opening_.skullFromMandible(p);
  double c = stretched(p, {0, 34, 13}, {34, 40, 30}, cavity_raised_mm_);
  c = smoothMin(c, stretched(p, {31, 35, 6}, {16.5, 36, 20}, cavity_raised_mm_), 8.0);
  c = smoothMin(c, ellipsoid(k, {0, 10, 7}, {26, 16, 11}), 8.0);
  c = smoothMin(c, ellipsoid(p, {0, 70, 2}, {18, 22, 24}), 10.0);
  return c;
}

double HeadShape::distance_mm(const dvec3& p) const {
  double d = closed_mm(p);
  const dvec3 from_mouth = p - dvec3(4, 24, 8);
  if (d > 20.0 || glm::dot(from_mouth, from_mouth) > 84.0 * 84.0) return d;
  // Far behind the lips the opening has no effect.
  const double behind = p.y - 36.0;
  const double opening = behind > 22.0 ? 1e3 : rim_.opening_mm(p.x, p.z);
  const double hole = behind > 22.0 ? behind : std::max(opening, behind);
  d = smoothMax(d, -smoothMin(hole, cavity_mm(p), 4.0), 4.0);
  d = smoothMin(d, std::min(upperGingiva_mm(opening_.skullFromMandible(p)), lowerGingiva_mm(p)), 3.0);
  if (std::abs(opening) < 24.0) d = smoothMin(d, rim_.lip(p).distance_mm, 7.0);
  return smoothMax(d, -jawSegmentSpace_mm(p), 3.0);
}

}  // namespace assets
