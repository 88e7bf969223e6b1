#include "assets/synthetic/facial_hair.h"

#include <cmath>
#include <optional>

#include "assets/synthetic/face_frames.h"
#include "assets/vertex_normals.h"
#include "calibration/geometry/units.h"
#include "calibration/random.h"

namespace assets {
namespace {

using glm::dvec3;

// Skin behind a point of the frontal plane, in the skull's frame.
dvec3 rootAt(const HeadShape& head, double x_K, double z_K) {
  dvec3 k(x_K, -45.0, z_K);
  for (int step = 0; step < 120; ++step) {
    const double d = head.closed_mm(head.opening().mandibleFromSkull(k));
    if (d < 0.02) break;
    k.y += 0.75 * d;
  }
  return k;
}

// A hair from its root along `direction`, bending by `droop`, in the skull's frame.
void addHair(MeshPart& part, const MouthOpening& opening, const dvec3& root_K, const dvec3& direction,
             const dvec3& droop, double length, double radius) {
  constexpr int kRings = 4;
  constexpr int kSides = 3;
  const auto first = static_cast<std::uint32_t>(part.position_mm.size());
  const dvec3 side = glm::normalize(glm::cross(direction, dvec3(0.3, 0.5, 0.8)));
  const dvec3 other = glm::cross(glm::normalize(direction), side);
  for (int ring = 0; ring < kRings; ++ring) {
    const double t = static_cast<double>(ring) / (kRings - 1);
    const dvec3 centre = root_K + length * (t * direction + t * t * droop);
    const double r = radius * (1.0 - 0.85 * t);
    for (int n = 0; n < kSides; ++n) {
      const double turn = 2.0 * calibration::kPi * n / kSides;
      part.position_mm.emplace_back(
          opening.mandibleFromSkull(centre + r * (std::cos(turn) * side + std::sin(turn) * other)));
    }
  }
  for (int ring = 0; ring + 1 < kRings; ++ring) {
    for (int n = 0; n < kSides; ++n) {
      const auto at = [&](int r, int s) { return first + static_cast<std::uint32_t>(r * kSides + s % kSides); };
      part.triangles.insert(part.triangles.end(), {at(ring, n), at(ring + 1, n), at(ring + 1, n + 1)});
      part.triangles.insert(part.triangles.end(), {at(ring, n), at(ring + 1, n + 1), at(ring, n + 1)});
    }
  }
}

}  // namespace

MeshPart facialHair(const HeadShape& head, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto between = [&](double low, double high) { return calibration::uniform(random, low, high); };
  MeshPart part;
  for (const double side : {1.0, -1.0}) {
    // Brow: dense and upright near the nose, thin and lying toward the temple.
    for (int n = 0; n < 340; ++n) {
      const double u = between(0.0, 1.0);
      const double x = 12.5 + 33.0 * u;
      const double middle = 84.6 + 5.6 * std::sin(1.9 * u) - 3.4 * u * u;
      const double thick = 3.3 * (1.0 - 0.72 * u) * std::min(1.0, 0.45 + 6.0 * u);
      const dvec3 root = rootAt(head, side * x, middle + between(-1.0, 1.0) * thick);
      const double lie = smoothStep(-0.05, 0.55, u);
      const dvec3 direction = glm::normalize(
          dvec3(side * glm::mix(0.25, 0.95, lie), -0.20 + 0.25 * u, glm::mix(0.95, 0.18, lie) + between(-0.2, 0.2)));
      addHair(part, head.opening(), root, direction, {side * 0.12, 0.08, -0.16},
              between(3.6, 6.2) * (0.75 + 0.25 * lie), between(0.07, 0.12));
    }
    // Lashes fan out from the closed lid's edge.
    for (int n = 0; n < 64; ++n) {
      const double across = -0.95 + 1.9 * (n + between(0.0, 1.0)) / 64.0;
      const double x = 31.5 + 15.0 * across;
      const dvec3 root = rootAt(head, side * x, 69.6 - 4.6 * std::max(1.0 - across * across, -0.3));
      const dvec3 direction = glm::normalize(dvec3(side * (0.45 * across + 0.1), -0.75, -0.62));
      addHair(part, head.opening(), root + dvec3(0, 0.3, 0), direction, {side * 0.1 * across, -0.12, 0.34},
              between(4.0, 6.5) * (0.8 + 0.25 * across), 0.13);
    }
  }
  part.normal = vertexNormals(part.position_mm, part.triangles);
  return part;
}

}  // namespace assets
