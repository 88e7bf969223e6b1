#include "tests/bench/render/synthetic_head.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace bench {
namespace {

double smooth(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

double hashed(int i, int j, int k) {
  std::uint32_t h = 0x811c9dc5u;
  for (const int c : {i, j, k}) h = (h ^ static_cast<std::uint32_t>(c)) * 0x01000193u, h ^= h >> 13;
  h *= 0x5bd1e995u;
  return static_cast<double>((h ^ (h >> 15)) & 0xffffu) / 65535.0;
}

/// Value noise 0..1 of period one.
double noise(glm::dvec3 p) {
  const glm::dvec3 base = glm::floor(p), f = p - base, s = f * f * (3.0 - 2.0 * f);
  double sum = 0.0;
  for (int n = 0; n < 8; ++n) {
    const glm::ivec3 corner(n & 1, (n >> 1) & 1, n >> 2), cell = glm::ivec3(base) + corner;
    const glm::dvec3 w = glm::mix(1.0 - s, s, glm::dvec3(corner));
    sum += w.x * w.y * w.z * hashed(cell.x, cell.y, cell.z);
  }
  return sum;
}

double box(glm::dvec3 p, glm::dvec3 half, double round) {
  const glm::dvec3 q = glm::abs(p) - half;
  return glm::length(glm::max(q, glm::dvec3(0.0))) + std::min(std::max({q.x, q.y, q.z}), 0.0) - round;
}

constexpr double kArchBend = 0.045;  // y = bend x², mm

/// Distance to the arch's line seen from above, past its ends too; negative within.
double archDistance(glm::dvec3 p, bool upper) {
  const double across = (p.y - kArchBend * p.x * p.x) / std::hypot(1.0, 2.0 * kArchBend * p.x);
  return std::max(box({across, 0.0, p.z - (upper ? 17.0 : -18.0)}, {5.5, 0.0, upper ? 8.0 : 12.0}, 2.5),
                  std::abs(p.x) - 30.0);
}

double ramusDistance(glm::dvec3 p) {
  return box({std::abs(p.x) - 33.0, p.y - 54.0, p.z + 2.0}, {3.5, 11.0, 30.0}, 2.0);
}

double withBone(double hu, double distance, glm::dvec3 p) {
  if (distance > 0.6) return hu;
  const double core = smooth(1.8, 2.6, -distance);
  return std::lerp(hu, std::lerp(1350.0, 180.0 + 700.0 * noise(1.1 * p), core), smooth(-0.35, 0.35, -distance));
}

double withTeeth(double hu, glm::dvec3 p) {
  for (const bool upper : {false, true})
    for (int n = 0; n < 14; ++n) {
      const double place = n % 7 + 0.5, x = (n < 7 ? 1.0 : -1.0) * (4.4 * place - 0.1 * place * place);
      const double width = place < 2.0 ? 3.2 : place < 4.0 ? 3.5 : 4.8, height = upper ? 9.0 : 8.5;
      const glm::dvec3 q = p - glm::dvec3(x, kArchBend * x * x, 0.0);
      const double along = upper ? q.z : -q.z, rho = std::sqrt(q.x * q.x + q.y * q.y);
      if (rho > 7.0 || along < -1.0 || along > 24.0) continue;
      const double taper = along < height ? 1.0 - 0.05 * std::sin(0.5 * along) * std::sin(0.5 * along)
                                          : std::max(0.25, 1.0 - 0.057 * (along - height));
      const double cusp = 0.5 * std::sin(1.4 * q.x) * std::sin(1.4 * q.y);
      const double distance = std::max(rho - width * taper, std::max(1.0 + cusp - along, along - 22.0));
      if (distance > 0.6) continue;
      const bool is_pulp = rho < 0.25 * width && along > 3.0, is_enamel = along < height && distance > -1.3;
      hu = std::lerp(hu, is_pulp ? 100.0 : is_enamel ? 2700.0 : 1650.0, smooth(-0.3, 0.3, -distance));
    }
  return hu;
}

}  // namespace

assets::VolumeGrid headGrid(int voxels_along_edge) {
  const double spacing_mm = kHead_mm / voxels_along_edge;
  return {glm::ivec3(voxels_along_edge), spacing_mm, glm::dvec3(0.5 * spacing_mm)};
}

std::vector<std::int16_t> syntheticHead(const assets::VolumeGrid& grid) {
  std::vector<std::int16_t> hounsfield(grid.voxelCount());
  tbb::parallel_for(0, grid.size.z, [&](int k) {
    for (int j = 0; j < grid.size.y; ++j)
      for (int i = 0; i < grid.size.x; ++i) {
        const glm::dvec3 p = grid.centre_P_mm({i, j, k}) - glm::dvec3(51.2, 35.0, 51.2);
        const double head = 46.0 * (1.0 - glm::length((p - glm::dvec3(0, 20, 0)) / glm::dvec3(46, 52, 49)));
        const double mouth = 1.0 - glm::length((p - glm::dvec3(0, 22, 0)) / glm::dvec3(18, 20, 9));
        double hu = std::lerp(-1000.0, 40.0 + 30.0 * (noise(0.6 * p) - 0.5), smooth(-0.4, 0.4, head));
        hu = std::lerp(hu, -1000.0, smooth(-0.03, 0.03, mouth));
        hu = withBone(hu, archDistance(p, false), p);
        hu = withBone(hu, archDistance(p, true), p);
        hu = withTeeth(withBone(hu, ramusDistance(p), p), p);
        hu += 25.0 * (hashed(i, j, k) - 0.5);
        hounsfield[grid.index({i, j, k})] = static_cast<std::int16_t>(std::clamp(hu, -1024.0, 3071.0));
      }
  });
  return hounsfield;
}

std::uint8_t solidOf(int hounsfield) {
  return static_cast<std::uint8_t>(
      std::lround(std::clamp((hounsfield - kSurface_HU) / 2000.0 + 0.5, 0.0, 1.0) * 255.0));
}

double opacityPerVoxel(double hounsfield) {
  if (hounsfield < kHalfway_HU)
    return kHalfway * std::max((hounsfield - kSurface_HU) / (kHalfway_HU - kSurface_HU), 0.0);
  return std::min(std::lerp(kHalfway, kOpaque, (hounsfield - kHalfway_HU) / (kOpaqueFrom_HU - kHalfway_HU)), kOpaque);
}

glm::dvec3 burCentre_mm(int frame) {
  const double x = 20.0 - 0.6 * frame, slope = 2.0 * kArchBend * x, length = std::hypot(1.0, slope);
  return glm::dvec3(51.2, 35.0, 51.2) + glm::dvec3(x, kArchBend * x * x, -16.0) +
         7.5 / length * glm::dvec3(slope, -1.0, 0.0);
}

}  // namespace bench
