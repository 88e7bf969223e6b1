#include "assets/synthetic/mouth_interior.h"

#include <tbb/task_arena.h>

#include <span>
#include <vector>

#include "assets/synthetic/dental_arch.h"
#include "assets/synthetic/implicit_shape.h"
#include "assets/synthetic/mandible_shape.h"
#include "assets/synthetic/tooth_row.h"

namespace assets {
namespace {

using glm::dvec2;
using glm::dvec3;

// Half arches through the middles of the crowns, from the midline back (x lateral, y posterior).
constexpr dvec2 kLowerArch[] = {{0, 0},       {5.4, 0.9},   {10.6, 4.4},  {14.7, 9.5}, {17.7, 16.0},
                                {20.2, 23.0}, {22.8, 32.0}, {25.3, 41.5}, {27.0, 48.0}};
constexpr dvec2 kUpperArch[] = {{0, -3},      {6.0, -2.0},  {12.2, 2.2},  {16.8, 8.0}, {20.3, 15.5},
                                {23.0, 23.0}, {25.4, 32.0}, {27.4, 41.5}, {28.5, 48.0}};

struct Crown {
  double width_mm;  ///< along the arch
  double depth_mm;  ///< across it
  double height_mm;
  int cusps;  ///< 0 incisal edge, 1 canine tip, 2 and more an occlusal surface
};
constexpr Crown kUpperCrowns[] = {{8.6, 7.0, 10.5, 0}, {6.6, 6.2, 9.2, 0},   {7.6, 8.0, 10.0, 1}, {7.1, 9.0, 8.5, 2},
                                  {6.8, 9.0, 8.3, 2},  {10.2, 11.0, 7.6, 4}, {9.6, 10.8, 7.2, 4}};
constexpr Crown kLowerFrontCrowns[] = {{5.3, 6.0, 9.0, 0}, {5.8, 6.4, 9.3, 0}, {6.9, 7.6, 10.4, 1}};

struct Station {
  dvec2 middle;
  dvec2 along;
};

Station stationAt(std::span<const dvec2> arch, double along_mm) {
  for (std::size_t n = 0; n + 1 < arch.size(); ++n) {
    const double length = glm::distance(arch[n], arch[n + 1]);
    if (along_mm <= length || n + 2 == arch.size()) {
      // Direction interpolated towards the neighbours'.
      const double t = along_mm / length;
      const dvec2 here = (arch[n + 1] - arch[n]) / length;
      const dvec2 before = n == 0 ? dvec2(1, 0) : glm::normalize(arch[n] - arch[n - 1]);
      const dvec2 after = n + 2 < arch.size() ? glm::normalize(arch[n + 2] - arch[n + 1]) : here;
      const dvec2 bent =
          t < 0.5 ? glm::mix(before + here, 2.0 * here, 2.0 * t) : glm::mix(2.0 * here, here + after, 2.0 * t - 1.0);
      return {glm::mix(arch[n], arch[n + 1], t), glm::normalize(bent)};
    }
    along_mm -= length;
  }
  return {arch.back(), {0, 1}};
}

// A crown in its own frame: x along the arch, y outward, z from the gingiva to the cutting edge.
double crown(const Crown& c, const dvec3& p) {
  const double up = std::clamp(p.z / c.height_mm, -0.5, 1.2);
  // Narrow at the gingiva, widest at two thirds; front teeth thin toward their edge.
  const double belly = 1.0 - 0.16 * (up - 0.65) * (up - 0.65) / 0.42;
  const double thin = c.cusps < 2 ? glm::mix(1.0, c.cusps == 0 ? 0.24 : 0.45, smoothStep(0.15, 1.05, up))
                                  : 1.0 - 0.12 * smoothStep(0.5, 1.0, up);
  const double a = 0.5 * c.width_mm * belly;
  const double b = 0.5 * c.depth_mm * thin * (c.cusps < 2 ? 1.0 : belly);
  const double lean = c.cusps < 2 ? 0.09 * c.depth_mm * (1.0 - up) : 0.0;
  const double x = std::abs(p.x) / a;
  const double y = std::abs(p.y + lean - 0.3) / b;
  const double ring = std::pow(std::pow(x, 3.0) + std::pow(y, 2.6), 1.0 / 2.8);
  double d = (ring - 1.0) * std::min(a, b) * 0.85;
  // The top: an edge, a point, or cusps around a groove.
  double top = c.height_mm;
  if (c.cusps == 0) top -= 0.5 * std::pow(std::abs(p.x) / (0.5 * c.width_mm), 3.0);
  if (c.cusps == 1) top -= 2.0 * std::abs(p.x) / (0.5 * c.width_mm);
  if (c.cusps == 2) top -= 1.0 + 1.2 * std::cos(6.28 * p.y / c.depth_mm * 0.95) + 0.8 * std::pow(p.x / a, 2.0);
  if (c.cusps == 4) {
    // Rounded fissures: a steeper valley is finer than the mesh and comes out as saw teeth.
    const double cross =
        std::abs(std::sin(3.14 * p.x / c.width_mm * 1.7)) * std::abs(std::sin(3.14 * p.y / c.depth_mm * 1.7));
    top -= 1.9 - 2.1 * cross / (cross + 0.12);
  }
  d = smoothMax(d, (p.z - top) * 0.8, 1.2);
  return std::max(d, -p.z - 3.0);
}

// The teeth of a half arch from the midline on; z counted from the occlusal plane toward the gingiva.
double row(std::span<const dvec2> arch, std::span<const Crown> crowns, const dvec3& p, double toward_gingiva) {
  double d = 1e9;
  double along = 0.05;
  for (const Crown& c : crowns) {
    along += 0.5 * c.width_mm;
    const Station s = stationAt(arch, along);
    along += 0.5 * c.width_mm;
    const dvec2 offset = dvec2(p.x, p.y) - s.middle;
    const double z = c.height_mm - p.z * toward_gingiva;
    if (glm::dot(offset, offset) > 14.0 * 14.0) {
      d = std::min(d, glm::length(offset) - 8.0);
      continue;
    }
    const dvec2 outward(s.along.y, -s.along.x);
    d = std::min(d, crown(c, {glm::dot(offset, s.along), glm::dot(offset, outward), z}));
  }
  return d;
}

// Premolars and molars in the shapes of the scanned teeth, down to the gingiva.
double lowerBackTeeth(const dvec3& p) {
  // Isolated: the shapes are built in parallel, and a waiting thread must not come back here for another task.
  static const std::vector<PlacedTooth> kTeeth = tbb::this_task_arena::isolate([] {
    const DentalArch arch;
    std::vector<PlacedTooth> placed;
    for (int position = 4; position <= 7; ++position) placed.push_back(eruptedTooth(arch, position));
    return placed;
  });
  constexpr double kExact_mm = 3.0, kUnderGingiva_mm = -11.5;
  double d = 1e9;
  for (const PlacedTooth& tooth : kTeeth) {
    const dvec3 q = tooth.local(p);
    const double bound = tooth.shape.outerLowerBound_mm(q);
    d = std::min(d, bound > kExact_mm ? bound : tooth.shape.outer_mm(q));
  }
  return std::max(d, kUnderGingiva_mm - p.z);
}

// A ridge of gingiva along an arch, scalloped a little between the teeth.
double ridge(std::span<const dvec2> arch, const dvec3& p, double z, double radius, double tall) {
  double d = 1e9;
  for (std::size_t n = 0; n + 1 < arch.size(); ++n) {
    const dvec3 squeezed(p.x, p.y, z + (p.z - z) / tall);
    d = std::min(d, capsule(squeezed, {arch[n].x, arch[n].y, z}, {arch[n + 1].x, arch[n + 1].y, z}, radius, radius));
  }
  return d;
}

}  // namespace

double upperGingiva_mm(const dvec3& k) {
  const dvec3 m(std::abs(k.x), k.y, k.z);
  // Ridge, and the palate's vault between its limbs.
  const double limbs = ridge(kUpperArch, m, 17.0, 5.8, 1.65);
  double vault = ellipsoid(k, {0, 30, 34}, {30, 38, 13});
  vault += 0.35 * std::sin(k.y * 1.1) * bump(k, {0, 10, 24}, {12, 9, 8});
  return smoothMin(limbs, vault, 9.0);
}

double lowerGingiva_mm(const dvec3& p) {
  // Front teeth on both sides, the whole row on the free side; the floor of the mouth inside it.
  const dvec3 mirrored(-p.x, p.y, p.z);
  double d = ridge(kLowerArch, mirrored, -17.5, 4.8, 1.8);
  d = smoothMin(d, ridge(std::span(kLowerArch).first(5), p, -17.0, 5.2, 1.8), 2.0);
  const double floor = ellipsoid(p, {-4, 34, -34}, {26, 40, 20});
  return smoothMin(d, floor, 8.0);
}

double upperTeeth_mm(const dvec3& k) {
  const dvec3 m(std::abs(k.x), k.y, k.z + 0.6 - 0.035 * k.y);
  return row(kUpperArch, kUpperCrowns, m, 1.0);
}

double lowerTeeth_mm(const dvec3& p) {
  const dvec3 mirrored(-p.x, p.y, p.z);
  const double free_side = std::min(row(kLowerArch, kLowerFrontCrowns, mirrored, -1.0), lowerBackTeeth(mirrored));
  const double operated_side = row(kLowerArch, kLowerFrontCrowns, p, -1.0);
  return std::min(free_side, std::max(operated_side, -1.2 - jawSegmentSpace_mm(p)));
}

double tongue_mm(const dvec3& p) {
  // Displaced from the operated side.
  const dvec3 q(p.x + 6.5 - 0.05 * p.y, p.y, p.z);
  double d = ellipsoid(q, {0, 40, -9}, {19, 34, 15});
  d = smoothMin(d, ellipsoid(q, {0, 62, -4}, {18, 22, 17}), 14.0);
  d = smoothMin(d, ellipsoid(q, {0, 17, -7}, {13, 12, 8}), 10.0);
  d += 1.5 * std::exp(-q.x * q.x / 7.0) * smoothStep(-8.0, 2.0, q.z) * smoothStep(6.0, 20.0, q.y);
  d += 0.05 * std::sin(q.x * 2.9 + 1.3 * std::sin(q.y * 0.9)) * std::sin(q.y * 2.6 + 1.5 * std::sin(q.x * 1.3));
  // Its edge yields to the row of teeth.
  const double teeth = ridge(kLowerArch, {std::abs(p.x), p.y, p.z}, -4.0, 6.6, 1.6);
  return smoothMax(d, -teeth, 3.0);
}

double jawSegmentSpace_mm(const dvec3& p) {
  // The body follows the arch and widens towards the ramus.
  double d = 1e9;
  constexpr dvec3 kCourse[] = {{15.4, 10.0, 8.2},  {18.2, 16.5, 8.0},  {21.2, 24.0, 8.0}, {23.6, 32.0, 9.0},
                               {27.4, 41.5, 10.0}, {32.0, 52.0, 11.0}, {37.2, 68.0, 11.0}};
  const double upper = 3.0 + 8.0 * smoothStep(34.0, 58.0, p.y);
  for (std::size_t n = 0; n + 1 < std::size(kCourse); ++n) {
    const dvec2 a(kCourse[n]), b(kCourse[n + 1]), at(p.x, p.y);
    const double t = nearestOnSegment(at, a, b);
    const double half = glm::mix(kCourse[n].z, kCourse[n + 1].z, t);
    d = std::min(d, glm::length(at - glm::mix(a, b, t)) - half);
  }
  const double vertical = std::max(p.z - upper, -39.0 - p.z);
  // The scan begins behind the canine; in front of it face and gingiva are whole.
  static const ArchStation kCut = anteriorCut(DentalArch());
  constexpr double kGap_mm = 0.4;
  const double anterior = glm::dot(kCut.centre_mm - dvec2(p), kCut.distal) - kGap_mm;
  return std::max(-smoothMin(-d, -vertical, 5.0), anterior);
}

}  // namespace assets
