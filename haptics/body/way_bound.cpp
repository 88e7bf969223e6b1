#include "haptics/body/way_bound.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace haptics {
namespace {

constexpr double kCell_mm = 0.6;

/// Cross section of a ball's front that is in solid: the segment of its great circle up to the depth. 4/3 d sqrt(2 r d)
/// for a shallow one, at most the circle.
double frontInSolid_mm2(double radius_mm, double clearance_mm) {
  const double depth_mm = std::clamp(radius_mm - kCell_mm / 2.0 - clearance_mm, 0.0, 2.0 * radius_mm);
  const double cosine = (radius_mm - depth_mm) / radius_mm;
  return radius_mm * radius_mm * (std::acos(cosine) - cosine * std::sqrt(std::max(0.0, 1.0 - cosine * cosine)));
}

}  // namespace

WayBound::WayBound(const DistanceField& obstacles, const Ball& ball, const glm::dvec3& direction, double distance_mm,
                   double length_price, double solid_price, const std::stop_token& stop)
    : start_mm_(ball.start_mm), direction_(direction), distance_mm_(distance_mm), length_price_(length_price) {
  const assets::VolumeGrid& fine = obstacles.grid();
  const glm::dvec3 extent_mm = fine.spacing_mm * glm::dvec3(fine.size - 1);
  grid_ = {glm::ivec3(glm::floor(extent_mm / kCell_mm)) + 1, kCell_mm, fine.origin_P_mm};
  cost_.assign(grid_.voxelCount(), std::numeric_limits<float>::max());

  std::vector<float> price_per_mm(cost_.size());
  using Entry = std::pair<float, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  assets::forVoxels(grid_, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p_mm = grid_.centre_P_mm(ijk);
    price_per_mm[v] =
        static_cast<float>(length_price + solid_price * frontInSolid_mm2(ball.radius_mm, obstacles.at_mm(p_mm)));
    const double rest = inAir(p_mm);
    // Beyond the border it goes on in the air.
    const bool is_border = glm::any(glm::equal(ijk, glm::ivec3(0))) || glm::any(glm::equal(ijk, grid_.size - 1));
    if (rest <= 0.0 || is_border) open.emplace(cost_[v] = static_cast<float>(rest), v);
  });
  while (!open.empty() && !stop.stop_requested()) {
    const float cost = open.top().first;
    const std::size_t v = open.top().second;
    open.pop();
    if (cost > cost_[v]) continue;
    const glm::ivec3 ijk = assets::elementAt(grid_.size, v);
    assets::forVoxels(glm::max(ijk - 1, 0), glm::min(ijk + 2, grid_.size), [&](glm::ivec3 beside) {
      const std::size_t w = grid_.index(beside);
      if (w == v) return;
      const float step_mm = static_cast<float>(kCell_mm) * glm::length(glm::vec3(beside - ijk));
      const float there = cost + step_mm * 0.5F * (price_per_mm[v] + price_per_mm[w]);
      if (there < cost_[w]) open.emplace(cost_[w] = there, w);
    });
  }
}

double WayBound::at(const glm::dvec3& centre_mm) const {
  const glm::dvec3 index = grid_.indexFromPoint(centre_mm), last(grid_.size - 1);
  if (glm::any(glm::lessThan(index, glm::dvec3(0.0))) || glm::any(glm::greaterThan(index, last)))
    return inAir(centre_mm);
  const glm::ivec3 low = glm::clamp(glm::ivec3(index), glm::ivec3(0), glm::max(grid_.size - 2, 0));
  const glm::dvec3 f = index - glm::dvec3(low);
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::ivec3 offset = assets::cornerOffset(corner), ijk = glm::min(low + offset, grid_.size - 1);
    const glm::dvec3 weight = glm::mix(1.0 - f, f, glm::dvec3(offset));
    sum += weight.x * weight.y * weight.z * static_cast<double>(cost_[grid_.index(ijk)]);
  }
  return sum;
}

}  // namespace haptics
