#include "assets/synthetic/cheek_retractor.h"

#include <algorithm>
#include <cmath>

#include "assets/mesh/catmull_rom.h"
#include "assets/vertex_normals.h"
#include "calibration/geometry/units.h"

namespace assets {
namespace {

using glm::dvec3;

// Centre line relative to the retracted corner, from the tip inside the mouth to the end of the handle, and the width.
struct Bend {
  dvec3 from_corner_mm;
  double width_mm;
};
constexpr Bend kCourse[] = {{{-8.6, 31, -9}, 9},    {{-7.4, 25, -8}, 12},  {{-5.8, 15, -4}, 13},
                            {{-5.8, 5, -1}, 12.5},  {{-5.4, -4.5, 0}, 12}, {{1.5, -10.2, -0.5}, 12},
                            {{13, -9.5, -3}, 12.5}, {{36, -5, -9}, 14},    {{64, -9, -18}, 15},
                            {{90, -16, -27}, 14},   {{102, -20, -31}, 9}};
constexpr double kHalfThickness_mm = 0.6;
constexpr int kPerSpan = 8;
constexpr int kAround = 16;

}  // namespace

MeshPart cheekRetractor(const MouthRim& rim) {
  const dvec3 corner = rim.retractedCorner_mm();
  std::vector<dvec3> line;
  std::vector<double> width;
  for (std::size_t span = 0; span + 1 < std::size(kCourse); ++span)
    for (int n = 0; n < kPerSpan; ++n) {
      const double t = static_cast<double>(n) / kPerSpan;
      line.push_back(corner + catmullRomAt(kCourse, span, t, &Bend::from_corner_mm));
      width.push_back(catmullRomAt(kCourse, span, t, &Bend::width_mm));
    }

  // Semicircular ends.
  MeshPart part;
  const std::size_t rings = line.size();
  for (std::size_t n = 0; n < rings; ++n) {
    const dvec3 along = glm::normalize(line[std::min(n + 1, rings - 1)] - line[n == 0 ? 0 : n - 1]);
    const dvec3 across = glm::normalize(dvec3(0, 0, 1) - along.z * along);
    const dvec3 up = glm::cross(along, across);
    const double from_end = std::min(glm::distance(line[n], line.front()), glm::distance(line[n], line.back()));
    const double half = 0.5 * width[n];
    const double closing =
        from_end >= half ? 1.0 : std::sqrt(std::max(0.0, 1.0 - std::pow(1.0 - from_end / half, 2.0)));
    for (int a = 0; a < kAround; ++a) {
      // A flat, slightly dished section with rounded edges.
      const double turn = 2.0 * calibration::kPi * (a + 0.5) / kAround;
      const double u = std::copysign(std::pow(std::abs(std::cos(turn)), 0.35), std::cos(turn));
      const double v = std::copysign(std::pow(std::abs(std::sin(turn)), 0.7), std::sin(turn));
      const double dish = 0.9 * (u * u - 0.4);
      part.position_mm.emplace_back(line[n] + half * std::max(closing, 0.02) * u * across +
                                    (kHalfThickness_mm * v + dish * closing) * up);
    }
  }
  for (std::uint32_t n = 0; n + 1 < rings; ++n) {
    for (std::uint32_t a = 0; a < kAround; ++a) {
      const auto at = [&](std::uint32_t ring, std::uint32_t s) { return ring * kAround + s % kAround; };
      part.triangles.insert(part.triangles.end(), {at(n, a), at(n + 1, a + 1), at(n + 1, a)});
      part.triangles.insert(part.triangles.end(), {at(n, a), at(n, a + 1), at(n + 1, a + 1)});
    }
  }
  part.normal = vertexNormals(part.position_mm, part.triangles);
  return part;
}

}  // namespace assets
