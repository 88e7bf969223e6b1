#include "app/case/arch_curve.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/case/trough_plan.h"
#include "assets/tooth.h"

namespace app {
namespace {

constexpr std::size_t kMinTeeth = 3;
constexpr double kPoint_mm = 0.5, kExtension_mm = 35.0;

/// Along the arch from the patient's right: -8 to -1, then 1 to 8.
int placeInArch(int fdi) { return assets::isRight(fdi) ? -assets::positionOf(fdi) : assets::positionOf(fdi); }

/// Centres of the numbered permanent teeth of one arch, from right to left.
std::vector<glm::dvec2> toothCentres(const assets::CtVolume& ct, bool upper) {
  std::array<assets::VoxelSum, 17> sums{};
  if (ct.tooth.empty()) return {};
  assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const int fdi = ct.tooth[v];
    if (!assets::isToothNumber(fdi) || assets::isPrimaryTooth(fdi) || assets::isUpper(fdi) != upper) return;
    assets::VoxelSum& sum = sums[static_cast<std::size_t>(placeInArch(fdi) + 8)];
    sum.count += 1.0;
    sum.sum += glm::dvec3(ijk);
  });
  std::vector<glm::dvec2> centres;
  for (const assets::VoxelSum& tooth : sums)
    if (tooth.count > 0.0) {
      const glm::dvec3 centre_P = ct.grid.origin_P_mm + ct.grid.spacing_mm * tooth.sum / tooth.count;
      centres.emplace_back(centre_P);
    }
  return centres;
}

/// Catmull-Rom through inner points b and c; `t` from 0 at b to 1 at c.
glm::dvec2 spline(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& d, double t) {
  const glm::dvec2 slope_b = 0.5 * (c - a), slope_c = 0.5 * (d - b);
  const double t2 = t * t, t3 = t2 * t;
  return (2.0 * t3 - 3.0 * t2 + 1.0) * b + (t3 - 2.0 * t2 + t) * slope_b + (3.0 * t2 - 2.0 * t3) * c +
         (t3 - t2) * slope_c;
}

std::vector<glm::dvec2> through(const std::vector<glm::dvec2>& centres) {
  std::vector<glm::dvec2> all{2.0 * centres[0] - centres[1]};
  all.insert(all.end(), centres.begin(), centres.end());
  all.push_back(2.0 * centres.back() - centres[centres.size() - 2]);
  std::vector<glm::dvec2> points;
  for (std::size_t n = 1; n + 2 < all.size(); ++n) {
    const int steps = std::max(1, static_cast<int>(std::lround(glm::distance(all[n], all[n + 1]) / kPoint_mm)));
    for (int s = 0; s < steps; ++s)
      points.push_back(spline(all[n - 1], all[n], all[n + 1], all[n + 2], static_cast<double>(s) / steps));
  }
  points.push_back(centres.back());
  return points;
}

/// Straight continuation from `end` away from `before`, as far as the volume reaches.
std::vector<glm::dvec2> extension(const assets::VolumeGrid& grid, const glm::dvec2& end, const glm::dvec2& before) {
  const glm::dvec2 low{grid.origin_P_mm}, high = low + grid.spacing_mm * glm::dvec2(grid.size - 1);
  const glm::dvec2 along = glm::normalize(end - before);
  std::vector<glm::dvec2> points;
  for (double s = kPoint_mm; s <= kExtension_mm; s += kPoint_mm) {
    const glm::dvec2 p = end + s * along;
    if (glm::any(glm::lessThan(p, low)) || glm::any(glm::greaterThan(p, high))) break;
    points.push_back(p);
  }
  return points;
}

}  // namespace

std::vector<glm::dvec2> archCurve_P_mm(const assets::Patient& patient) {
  const assets::CtVolume& ct = patient.ct;
  std::vector<glm::dvec2> centres = toothCentres(ct, patient.site && assets::isUpper(patient.site->fdi));
  if (centres.size() < kMinTeeth) {
    if (!patient.site) return {};
    // Mesial to distal runs to the patient's right on the right.
    const glm::dvec2 distal{archDirection_P(ct, *patient.site)}, middle{patient.site->centre_P_mm};
    const glm::dvec2 to_left = assets::isRight(patient.site->fdi) ? -distal : distal;
    centres = {middle - kPoint_mm * to_left, middle, middle + kPoint_mm * to_left};
  }
  const std::vector<glm::dvec2> inner = through(centres);
  std::vector<glm::dvec2> curve = extension(ct.grid, centres.front(), centres[1]);
  std::ranges::reverse(curve);
  curve.insert(curve.end(), inner.begin(), inner.end());
  const std::vector<glm::dvec2> end = extension(ct.grid, centres.back(), centres[centres.size() - 2]);
  curve.insert(curve.end(), end.begin(), end.end());
  return curve;
}

}  // namespace app
