#include "assets/synthetic/drape_shape.h"

#include <cmath>

#include "assets/synthetic/face_frames.h"

namespace assets {
namespace {

using glm::dvec3;

// Cloth over a body, with thickness, rolled hem and folds; ends where `under_mm` is negative.
double cloth(double body_mm, double under_mm, double thickness_mm, double folds_mm) {
  const double roll = 2.2 * std::exp(-std::pow((under_mm - 3.2) / 2.6, 2.0));
  const double band = 0.9 * std::exp(-std::pow((under_mm - 14.0) / 1.6, 2.0));
  const double settled = smoothStep(6.0, 26.0, under_mm);
  const double surface = body_mm - thickness_mm - roll + band * 0.8 - settled * folds_mm;
  return -smoothMin(-surface * 0.85, under_mm, 3.0);
}

}  // namespace

double depthUnderCap_mm(const dvec3& k) {
  // From the middle of the forehead down in front of the ears to the nape, a little lower at the temples.
  return (k.z + 0.80 * k.y - 88.0 + 0.0016 * k.x * k.x) / 1.28;
}

double depthUnderDrape_mm(const dvec3& p) {
  // Under the chin and along the lower border of the jaw, sagging between.
  return (-52.0 + 0.22 * p.y - 0.0022 * p.x * p.x - p.z) / 1.02;
}

double cap_mm(const HeadShape& head, const dvec3& p) {
  const dvec3 k = head.opening().skullFromMandible(p);
  const dvec3 m(std::abs(k.x), k.y, k.z);
  double body = head.closed_mm(p);
  body = smoothMin(body, ellipsoid(m, {70, 82, 62}, {11, 19, 32}), 12.0);
  // Spare cloth at the crown, gathered toward the hem.
  body = smoothMin(body, ellipsoid(k, {0, 96, 122}, {74, 88, 78}), 20.0);
  const double under = depthUnderCap_mm(k);
  const double around = std::atan2(k.x, k.y - 78.0 + 0.5 * k.z);
  const double fold = std::sin(around * 11.0 + 1.6 * std::sin(k.z * 0.05 + k.x * 0.03)) * 1.3 +
                      std::sin(around * 23.0 + 0.06 * k.z) * 0.5 + std::sin(k.z * 0.09 + k.x * 0.05) * 1.2;
  return cloth(body, under, 2.4, fold + 1.5);
}

double drape_mm(const HeadShape& head, const dvec3& p) {
  double body = head.closed_mm(p);
  const dvec3 q(std::abs(p.x), p.y, p.z);
  body = smoothMin(body, capsule(q, {0, 78, -40}, {0, 92, -150}, 60, 66), 22.0);
  body = smoothMin(body, ellipsoid(p, {0, 108, -188}, {190, 88, 112}), 48.0);
  const double fold = 2.4 * std::sin(p.x * 0.085 + 1.4 * std::sin(p.z * 0.035) + 0.4) * smoothStep(-60.0, -110.0, p.z) +
                      1.3 * std::sin(p.z * 0.12 + 0.0009 * p.x * p.x + 0.5 * std::sin(p.x * 0.06)) +
                      0.7 * std::sin(p.x * 0.19 - p.z * 0.07);
  // Ends outside the usual view: over the shoulders, on the chest.
  const double end = std::max({q.x - 140.0, -140.0 - p.z, p.y - 170.0});
  return -smoothMin(-cloth(body, depthUnderDrape_mm(p), 2.6, fold + 2.0), -end, 12.0);
}

}  // namespace assets
