#include "assets/import/third_molar.h"

#include <array>
#include <cmath>
#include <limits>

#include "assets/tissue.h"

namespace assets {

namespace {

constexpr double kSmallest_mm3 = 10.0;

/// Sums over the voxels of one tissue.
struct Moments {
  double count = 0.0;
  glm::dvec3 first{0.0};
  glm::dmat3 second{0.0};

  void add(const glm::dvec3& p) {
    count += 1.0;
    first += p;
    second += glm::outerProduct(p, p);
  }
  Moments& operator+=(const Moments& other) {
    count += other.count;
    first += other.first;
    second += other.second;
    return *this;
  }
  glm::dvec3 mean() const { return first / count; }
  glm::dmat3 covariance() const { return second / count - glm::outerProduct(mean(), mean()); }
};

struct LongAxis {
  glm::dvec3 direction;
  double elongation;  ///< ratio of the spread along it to the mean spread across it
};

/// First principal axis by power iteration.
LongAxis longAxisOf(const glm::dmat3& covariance, const glm::dvec3& start) {
  glm::dvec3 axis = start;
  for (int step = 0; step < 200; ++step) {
    const glm::dvec3 next = covariance * axis;
    if (glm::length(next) <= 0.0) break;
    axis = glm::normalize(next);
  }
  const double along = glm::dot(axis, covariance * axis);
  const double across = 0.5 * (covariance[0][0] + covariance[1][1] + covariance[2][2] - along);
  return {axis, across > 0.0 ? std::sqrt(along / across) : 1.0};
}

glm::dvec3 crownDirection(const Moments& whole, const Moments& enamel) {
  const glm::dvec3 to_enamel = enamel.count > 0.0 ? enamel.mean() - whole.mean() : glm::dvec3(0.0);
  const glm::dvec3 towards = glm::length(to_enamel) > 1.0e-6 ? glm::normalize(to_enamel) : glm::dvec3(0, 0, 1);
  constexpr double kClearlyLong = 1.2;
  const LongAxis axis = longAxisOf(whole.covariance(), towards);
  if (axis.elongation < kClearlyLong) return towards;
  return glm::dot(axis.direction, towards) < 0.0 ? -axis.direction : axis.direction;
}

/// Mean x of the most anterior 5 mm of a tissue, or NaN.
double frontOf(const VolumeGrid& grid, const std::vector<std::uint8_t>& label, Tissue tissue) {
  const auto value = static_cast<std::uint8_t>(tissue);
  const int depth = std::max(1, static_cast<int>(std::lround(5.0 / grid.spacing_mm)));
  double sum = 0.0;
  double count = 0.0;
  int end = grid.size.y;
  for (int j = 0; j < end; ++j)
    for (int k = 0; k < grid.size.z; ++k)
      for (int i = 0; i < grid.size.x; ++i) {
        if (label[grid.index({i, j, k})] != value) continue;
        end = std::min(end, j + depth);
        sum += i;
        count += 1.0;
      }
  return count > 0.0 ? grid.origin_P_mm.x + grid.spacing_mm * sum / count : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

OperatingSite thirdMolarSite(const VolumeGrid& grid, const std::vector<std::uint8_t>& label) {
  std::array<Moments, kTissueCount> tissue;
  for (int k = 0; k < grid.size.z; ++k)
    for (int j = 0; j < grid.size.y; ++j)
      for (int i = 0; i < grid.size.x; ++i) {
        const std::uint8_t value = label[grid.index({i, j, k})];
        // In voxels from the grid's middle, so that the squares keep their digits.
        if (value >= 4 && value <= 6) tissue[value].add(glm::dvec3(i, j, k) - 0.5 * glm::dvec3(grid.size));
      }
  const Moments& enamel = tissue[static_cast<std::size_t>(Tissue::enamel)];
  Moments hard = enamel;
  hard += tissue[static_cast<std::size_t>(Tissue::dentine)];

  OperatingSite site;
  if (hard.count * grid.voxelVolume_mm3() < kSmallest_mm3) return site;
  site.known = true;
  site.third_molar_P_mm = grid.origin_P_mm + grid.spacing_mm * (hard.mean() + 0.5 * glm::dvec3(grid.size));
  Moments whole = hard;
  whole += tissue[static_cast<std::size_t>(Tissue::pulp)];
  site.crown_direction_P = crownDirection(whole, enamel);

  double front_P_mm = frontOf(grid, label, Tissue::other_teeth);
  if (std::isnan(front_P_mm)) front_P_mm = frontOf(grid, label, Tissue::cortical);
  if (std::isnan(front_P_mm)) front_P_mm = grid.centre_P_mm(grid.size / 2).x;
  site.tooth_fdi = site.third_molar_P_mm.x < front_P_mm ? 48 : 38;
  return site;
}

}  // namespace assets
